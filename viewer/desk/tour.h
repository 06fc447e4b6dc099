#pragma once

#include <span>

namespace viewer {

struct Desk;

/// What a step of the tour points at.
enum class TourTarget { picture, look, what_if, ask, console };

struct TourStep {
  TourTarget target = TourTarget::picture;
  const char* title = "";
  const char* text = "";
};

/// A first look around the window.
std::span<const TourStep> tour_steps();

/// Shows a step, from 0; its panel, too. Throws std::out_of_range.
void show_tour(Desk& desk, int step);
void end_tour(Desk& desk);
/// On to the next step; ends after the last one.
void go_on_with_tour(Desk& desk);

}  // namespace viewer
