// Which operator is made, and what is said where none fits.
#include "radiosity/compressed/make_transport.h"

#include <gtest/gtest.h>

#include <string>

#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr std::size_t kPlenty = 1'000'000'000'000;
constexpr double kTolerance = 1e-2;

std::string refusal(const TransportChoice& choice, Index n_patches, std::size_t memory) {
  try {
    check_choice(choice, n_patches, 6, kTolerance, memory);
    return "";
  } catch (const SolveError& error) {
    return error.what();
  }
}

TEST(TransportChoice, IsDenseUpToTenThousandPatches) {
  EXPECT_EQ(chosen_kind({}, kMostDense, kTolerance, kPlenty), TransportKind::dense);
  EXPECT_EQ(chosen_kind({}, kMostDense + 1, kTolerance, kPlenty), TransportKind::compressed);
}

TEST(TransportChoice, IsDenseWhereMuchIsAsked) {
  EXPECT_EQ(chosen_kind({}, 100'000, 1e-3, kPlenty), TransportKind::dense);
  EXPECT_EQ(chosen_kind({}, 100'000, 1e-3, dense_transport_bytes(50'000)),
            TransportKind::compressed);
}

TEST(TransportChoice, IsCompressedWhereDenseDoesNotFit) {
  const std::size_t memory = dense_transport_bytes(5000);
  EXPECT_EQ(chosen_kind({}, 5000, kTolerance, memory), TransportKind::dense);
  EXPECT_EQ(chosen_kind({}, 5001, kTolerance, memory), TransportKind::compressed);
  EXPECT_EQ(refusal({}, 5001, memory), "");
}

TEST(TransportChoice, IsDenseForRows) {
  EXPECT_EQ(chosen_kind({.by_rows = true}, 50'000, kTolerance, kPlenty), TransportKind::dense);
  const std::string text = refusal({.by_rows = true}, 50'000, dense_transport_bytes(20'000));
  EXPECT_NE(text.find("6 GB"), std::string::npos) << text;
  EXPECT_NE(text.find("--method cg"), std::string::npos) << text;
  EXPECT_NE(text.find("--patches 20000"), std::string::npos) << text;
  EXPECT_NE(refusal({TransportKind::compressed, true}, 100, kPlenty).find("goes by rows"),
            std::string::npos);
}

TEST(TransportChoice, IsWhatIsSaid) {
  EXPECT_EQ(chosen_kind({TransportKind::dense}, 50'000, kTolerance, kPlenty), TransportKind::dense);
  EXPECT_EQ(chosen_kind({TransportKind::compressed}, 10, kTolerance, kPlenty),
            TransportKind::compressed);
  EXPECT_NE(refusal({TransportKind::dense}, 50'000, dense_transport_bytes(20'000)), "");
}

TEST(TransportChoice, TellsBothFiguresWhereNeitherFits) {
  const std::size_t memory = compressed_transport_bytes(20'000);
  const std::string text = refusal({}, 1'000'000, memory);
  EXPECT_NE(text.find(gigabytes(dense_transport_bytes(1'000'000))), std::string::npos) << text;
  EXPECT_NE(text.find("2.8 GB compressed"), std::string::npos) << text;
  EXPECT_NE(text.find("--patches 20000"), std::string::npos) << text;
}

TEST(MakeTransport, ReportsWhichItMade) {
  const PatchMesh mesh = test::box_in_box(4, 2);
  const Visibility visibility(mesh);
  EXPECT_FALSE(make_transport(mesh, visibility)->report().compression);
  EXPECT_TRUE(
      make_transport(mesh, visibility, {}, {TransportKind::compressed})->report().compression);
  EXPECT_THROW(make_transport(mesh, visibility, {.memory = 1000}), SolveError);
}

}  // namespace
}  // namespace radiosity
