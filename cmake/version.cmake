# Makes radiosity/version.h.

find_package(Git QUIET)
set(RADIOSITY_COMMIT "")
if(Git_FOUND)
  execute_process(
    COMMAND ${GIT_EXECUTABLE} rev-parse --show-toplevel --git-path logs/HEAD --short=12 HEAD
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE answer
    ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "\n" ";" answer "${answer}")
  list(LENGTH answer n_lines)
  if(n_lines EQUAL 3)
    list(GET answer 0 top)
    file(REAL_PATH "${PROJECT_SOURCE_DIR}" source)
    # Not that of a repository which holds a copy of the sources.
    if(top STREQUAL source)
      list(GET answer 1 log)
      list(GET answer 2 RADIOSITY_COMMIT)
      cmake_path(ABSOLUTE_PATH log BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      if(EXISTS ${log})
        # A line is added to it whenever the commit changes.
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${log})
      endif()
    endif()
  endif()
endif()
configure_file(radiosity/version.h.in generated/radiosity/version.h @ONLY)
