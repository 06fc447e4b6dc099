#include "apps/run/rank_start.h"

#include <cstddef>
#include <span>
#include <utility>

namespace apps {

RankStart::~RankStart() { tell(false); }

void RankStart::begin() { tell(true); }

void RankStart::tell(bool begins) {
  radiosity::Ranks* ranks = std::exchange(ranks_, nullptr);
  if (ranks == nullptr || ranks->rank() > 0) return;
  std::byte told{begins ? std::uint8_t{1} : std::uint8_t{0}};
  ranks->broadcast(0, std::span(&told, 1));
}

bool is_started(radiosity::Ranks& ranks) {
  std::byte told{};
  ranks.broadcast(0, std::span(&told, 1));
  return told != std::byte{};
}

}  // namespace apps
