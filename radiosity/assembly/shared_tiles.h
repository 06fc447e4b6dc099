#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "radiosity/assembly/exchange_assembly.h"
#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/assembly/tile_shares.h"
#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"

namespace radiosity {

/// Which rank keeps the tiles that all have made.
enum class TileKeeper {
  by_sums,  ///< each its share (TileShares::keeper)
  first     ///< the first, which may have some of them already
};

/// Has each rank make its share of all tiles (TileShares) and send them to the ranks that keep
/// them. The first rank tells how far all are. Every rank makes one and calls assemble_tiles() with
/// it, then finish().
class SharedTileSink final : public TileSink {
 public:
  /// `own` takes what this rank keeps; other ranks' tiles reach it on a thread of this object's.
  /// All must outlive this.
  SharedTileSink(TileSink& own, Ranks& ranks, TileKeeper keeper, const Progress& progress);
  ~SharedTileSink() override;
  SharedTileSink(const SharedTileSink&) = delete;
  SharedTileSink& operator=(const SharedTileSink&) = delete;

  void start(const TileLayout& layout) override;
  [[nodiscard]] bool owns(Index row_strip, Index column_strip) const override;
  [[nodiscard]] bool has(Index row_strip, Index column_strip) const override;
  void put(ExchangeTile tile) override;

  /// Waits until all ranks have made theirs. Throws what `own` has thrown on the way.
  void finish();

 private:
  [[nodiscard]] int keeper(Index row_strip, Index column_strip) const;
  void tell_what_is_there();
  void receive_all(const std::stop_token& stop);
  /// Takes a message; false if it was a rank's last one.
  bool take(const Ranks::Message& message);
  void keep(ExchangeTile tile);
  void count(double pairs);
  void show_progress();
  void send_count(bool is_last);

  TileSink& own_;
  Ranks& ranks_;
  TileKeeper keeper_;
  const Progress& progress_;
  std::optional<Strips> strips_;
  std::optional<TileShares> shares_;
  std::vector<std::uint8_t> is_there_;  // per tile
  double total_ = 0;                    // pairs of all ranks
  std::mutex mutex_;                    // guards the following
  double done_ = 0;                     // of these; on other ranks what the first has not been told
  std::exception_ptr error_;
  std::atomic<bool> has_failed_ = false;
  std::mutex telling_;  // guards the following, and that nothing is told after the last
  bool has_told_last_ = false;
  std::jthread receiver_;
};

/// assemble_tiles() by all ranks (TransportOptions::ranks) together, which call this with the sink
/// that takes what each keeps.
void share_tiles(const WholeMesh& whole, const Visibility& visibility,
                 const TransportOptions& options, const Coverage& coverage, TileKeeper keeper,
                 TileSink& own);

}  // namespace radiosity
