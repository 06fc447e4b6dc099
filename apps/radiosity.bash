# Completes commands, options and file names of radiosity: those that its own --help tells.
_radiosity() {
  local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command='' at
  for ((at = 1; at < COMP_CWORD; ++at)); do
    if [[ ${COMP_WORDS[at]} != -* ]]; then
      command=${COMP_WORDS[at]}
      break
    fi
  done
  if [[ -z $command && $word != -* ]]; then
    local commands='solve form-factors merge exchange comfort light daylight daylight-year render view inspect batch validate'
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  elif [[ $word == -* ]]; then
    local options
    options=$("$program" ${command:+"$command"} --help 2>/dev/null |
      grep --extended-regexp --only-matching '^ +(-[a-z],)?--[a-z-]+' |
      grep --only-matching -e '--[a-z-]*')
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o filenames -F _radiosity radiosity
