#include "apps/cluster/quiet_rank.h"

#include <fcntl.h>
#include <unistd.h>

#include <string>

namespace apps {

QuietRank::QuietRank(int rank) : true_stderr_(::dup(STDERR_FILENO)) {
  if (rank == 0) return;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietRank::~QuietRank() {
  if (true_stderr_ >= 0) ::close(true_stderr_);
}

void QuietRank::tell(std::string_view line) const {
  const std::string text = std::string(line) + "\n";
  [[maybe_unused]] const auto written = ::write(true_stderr_, text.data(), text.size());
}

}  // namespace apps
