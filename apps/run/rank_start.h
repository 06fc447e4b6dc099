#pragma once

#include "radiosity/base/ranks.h"

namespace apps {

/// On the first rank: lets the others begin with their share, or go home where there is nothing to
/// do or something was wrong before.
class RankStart {
 public:
  /// `ranks` may be null: there are no others.
  explicit RankStart(radiosity::Ranks* ranks) : ranks_(ranks) {}
  ~RankStart();
  RankStart(const RankStart&) = delete;
  RankStart& operator=(const RankStart&) = delete;

  /// They begin.
  void begin();

 private:
  void tell(bool begins);

  radiosity::Ranks* ranks_;
};

/// On the others: whether to begin.
bool is_started(radiosity::Ranks& ranks);

}  // namespace apps
