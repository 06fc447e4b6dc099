#include "radiosity/assembly/tile_record.h"

#include <gtest/gtest.h>

#include <random>

namespace radiosity {
namespace {

const Strips& strips() {
  static const Strips two({0, 9, 21});
  return two;
}

/// Some entries certain, some uncertain, the others 0.
ExchangeTile make_tile(bool is_diagonal, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  ExchangeTile tile;
  tile.row_strip = 0;
  tile.column_strip = is_diagonal ? 0 : 1;
  const Index rows = strips().rows(0);
  const Index columns = strips().rows(tile.column_strip);
  tile.values = Eigen::MatrixXd::Zero(rows, columns);
  const auto set = [&](Index row, Index column, double value, float error) {
    tile.values(row, column) = value;
    if (error > 0) {
      tile.uncertain.push_back(
          {static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(column), error});
    }
  };
  for (Index row = 0; row < rows; ++row) {
    for (Index column = is_diagonal ? row + 1 : 0; column < columns; ++column) {
      const double kind = uniform(random);
      if (kind < 0.3) continue;
      const float error = kind < 0.6 ? static_cast<float>(uniform(random)) : 0;
      const double value = uniform(random);
      set(row, column, value, error);
      if (is_diagonal) set(column, row, value, error);
    }
  }
  tile.census = {.facing = 30,
                 .visible = 11,
                 .hidden = 7,
                 .undecided = 12,
                 .partial = 5,
                 .rays = std::int64_t{1} << 40};
  return tile;
}

TEST(TileRecord, GivesTheTileBack) {
  std::mt19937_64 random(1);  // NOLINT: fixed seed
  for (int trial = 0; trial < 20; ++trial) {
    const ExchangeTile tile = make_tile(trial % 2 == 0, random);
    const std::vector<std::byte> record = encode_tile(tile);
    EXPECT_EQ(record.size() % 8, 0U);
    ASSERT_TRUE(is_sound(record, strips()));
    const ExchangeTile back =
        decode_tile(record, strips().rows(tile.row_strip), strips().rows(tile.column_strip));
    EXPECT_EQ(back.row_strip, tile.row_strip);
    EXPECT_EQ(back.column_strip, tile.column_strip);
    EXPECT_EQ(back.values, tile.values);
    ASSERT_EQ(back.uncertain.size(), tile.uncertain.size());
    for (std::size_t k = 0; k < tile.uncertain.size(); ++k) {
      EXPECT_EQ(back.uncertain[k].row, tile.uncertain[k].row);
      EXPECT_EQ(back.uncertain[k].column, tile.uncertain[k].column);
      EXPECT_EQ(back.uncertain[k].error, tile.uncertain[k].error);
    }
    EXPECT_EQ(back.census.facing, tile.census.facing);
    EXPECT_EQ(back.census.visible, tile.census.visible);
    EXPECT_EQ(back.census.hidden, tile.census.hidden);
    EXPECT_EQ(back.census.undecided, tile.census.undecided);
    EXPECT_EQ(back.census.partial, tile.census.partial);
    EXPECT_EQ(back.census.rays, tile.census.rays);
    EXPECT_EQ(back.census.known, 0);
  }
}

TEST(TileRecord, NoFlippedBitIsSound) {
  std::mt19937_64 random(2);  // NOLINT: fixed seed
  const std::vector<std::byte> record = encode_tile(make_tile(false, random));
  for (std::size_t place = 0; place < record.size(); ++place) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::vector<std::byte> damaged = record;
      damaged[place] ^= std::byte(1U << bit);
      EXPECT_FALSE(is_sound(damaged, strips())) << "byte " << place << ", bit " << bit;
    }
  }
}

TEST(TileRecord, TornOnesAndThoseOfOtherStripsAreNotSound) {
  std::mt19937_64 random(3);  // NOLINT: fixed seed
  const std::vector<std::byte> record = encode_tile(make_tile(false, random));
  for (std::size_t size = sizeof(RecordHeader); size < record.size(); size += 8) {
    EXPECT_FALSE(is_sound(std::span(record).first(size), strips())) << size;
  }
  EXPECT_FALSE(is_sound(record, Strips({0, 9})));
  EXPECT_FALSE(is_sound(record, Strips({0, 2, 4})));
}

}  // namespace
}  // namespace radiosity
