#include "viewer/desk/tour.h"

#include <array>
#include <stdexcept>

#include "viewer/desk/desk.h"

namespace viewer {
namespace {

constexpr std::array kSteps = {
    TourStep{TourTarget::picture, "The scene",
             "Drag to turn it, roll the wheel to come nearer, drag with the right button to look "
             "around. The corner tells how far the light can be trusted while it is being solved."},
    TourStep{TourTarget::look, "Look",
             "The light as the eye sees it, or any quantity in false colour: illuminance in lux, "
             "radiosity, direct and indirect light, what each value may be off by."},
    TourStep{TourTarget::what_if, "What if",
             "Switch and dim lamps, change what materials reflect: the picture follows. Ctrl+Z "
             "takes changes back. Pin the light in 'Compare' to see what has changed."},
    TourStep{TourTarget::ask, "Ask",
             "Click any place in the picture: its numbers with their errors, where its light comes "
             "from, what it sees. Below, 'Watch' steps through the ways to solve for the light."},
    TourStep{TourTarget::console, "Progress and messages",
             "How far the work is, what the mouse points at, and what there is to say about the "
             "file. Press ? for all keys; this tour is in the menu Help."}};

}  // namespace

std::span<const TourStep> tour_steps() { return kSteps; }

void show_tour(Desk& desk, int step) {
  if (step < 0 || step >= static_cast<int>(kSteps.size())) {
    throw std::out_of_range("there is no such step of the tour");
  }
  desk.tour_step = step;
  desk.shows_panels = true;
}

void end_tour(Desk& desk) { desk.tour_step.reset(); }

void go_on_with_tour(Desk& desk) {
  const int next = desk.tour_step.value_or(-1) + 1;
  if (next < static_cast<int>(kSteps.size())) {
    show_tour(desk, next);
  } else {
    end_tour(desk);
  }
}

}  // namespace viewer
