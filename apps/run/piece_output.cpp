#include "apps/run/piece_output.h"

#include <system_error>

#include "io/base/extension.h"
#include "io/result/pvtp_file.h"

namespace apps {

bool is_in_pieces(const std::filesystem::path& path) {
  return io::lower_case_extension(path) == ".pvtp";
}

void write_in_pieces(const std::filesystem::path& path, radiosity::Ranks& ranks,
                     const radiosity::PatchMesh& mesh, const radiosity::Solution& solution,
                     const io::ResultOptions& options) {
  on_first_rank(&ranks, [&] {
    std::error_code if_there_is_none;
    std::filesystem::remove(path, if_there_is_none);
  });
  io::write_piece(path, {ranks.rank(), ranks.size()}, mesh, solution, options);
  // Whoever could not write does not come here.
  (void)least_of_ranks(ranks, 0);
  on_first_rank(&ranks,
                [&] { io::write_piece_index(path, ranks.size(), mesh, solution, options); });
}

}  // namespace apps
