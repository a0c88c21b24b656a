// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/walking/walk.h"
#include "optimizer/walk/landing.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

struct Model;
struct FigurePlace;

// Where to walk from, once the ground is there.
using WalkPlace = std::function<Result<StartPlace>(const WalkedGround&)>;

// Views that one came from, apart from what can be undone.
class ViewHistory {
 public:
  struct View {
    Camera camera;
    std::optional<Eigen::Vector3d> feet;  // of whoever walked there
    std::optional<double> cut_height_m;
    std::optional<std::uint64_t> jumped_at;          // steps of the session when a teleport or a jump left this view
    std::vector<std::filesystem::path> clouds = {};  // that gave way to the model when this view was left
  };
  void push(const View& view);
  std::optional<View> back();
  bool empty() const { return views_.empty(); }
  // Whether the last thing that happened is a jump: nothing in the session has changed since.
  bool endsInJump(std::uint64_t steps) const { return !views_.empty() && views_.back().jumped_at == steps; }

 private:
  std::vector<View> views_;
};

// Where the next release of a key or click puts somebody.
struct TeleportAim {
  bool by_key = false, by_click = false;
  double begun_s = 0;       // by key, of the interface's clock
  double goes_on_to_s = 0;  // after a tap of the key: until then a click goes on to another place
  bool active() const { return by_key || by_click; }
};

// From where one looks, or at the entrance. What is needed for it is prepared first.
void startWalking(Model& model);
// Stands at a place that is pointed at, in a room, or at the station of that index, and walks on from there.
void teleport(Model& model, const RayHit& hit);
void jumpToRoom(Model& model, std::uint32_t product);
void jumpToStorey(Model& model, std::int32_t node);  // index into Environment::spatial
void jumpToStation(Model& model, std::size_t station);
// "" or why nobody can be put where that is, as trSentence() knows it.
std::string whyNoLanding(const Landing& landing, const Model& model);

void stopWalking(Model& model);
void rememberView(Model& model);  // for Alt+Left
// Whoever stands there looks as `camera` does.
void walkFromEye(Model& model, const Eigen::Vector3d& eye, const Camera& camera);
// From near and indoors, from where most is free around it; the view before comes back with Alt+Left.
void flyTo(Model& model, const Eigen::Vector3d& place);
// A worst place is marked and brought into view: in the model, from above and aslant with what lies over its room cut
// away, or from within where it would not be seen so. What was measured around it is drawn over the model. The view
// before comes back with Alt+Left.
void showWorstPlace(Model& model, FigurePlace place);
void goBackInViews(Model& model);
bool canUndoJump(const Model& model);  // by goBackInViews()
// Until the ground is there and the place is chosen, whoever wants to walk or jump can still give it up.
bool awaitsWalk(const Model& model);
void giveUpWalk(Model& model);
// To be called once a frame: begins to walk when the ground is there.
void followWalking(Model& model);

// "headroom 1.79 m" or "too narrow", and what passes there: "a body of 1.7 m with a radius of 0.25 m passes".
std::string tightPlaceName(const TightPlace& place, const Body& agent);
std::string whoPasses(const TightPlace& place);

// "Living room · Ground floor", of what there is, around the feet of whoever walks.
std::string walkPlaceName(const Model& model);
// "Living room · Ground floor", of what there is, of a place of the model as it was imported, or of a surface of it.
std::string placeName(const Model& model, const Eigen::Vector3d& place);
// The name of the storey that a floor of that height belongs to, local frame; "" where there is none.
std::string storeyNameAt(const Model& model, double floor_m);

}  // namespace standpoint
