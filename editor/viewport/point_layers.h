// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "editor/model/view_state.h"
#include "editor/points/cloud_nodes.h"
#include "editor/points/node_choice.h"
#include "editor/points/splatter.h"

namespace standpoint {

// How OpenGL draws what the points are drawn with.
struct PointLens {
  Eigen::Matrix4d clip_from_local = Eigen::Matrix4d::Identity();
  DepthRange depths;
};

// All clouds of a scene: the scan that is shown instead of the model, or what lies under it. A picture is first drawn
// of as many points as there is time for, an even part of all, and then refined until it has all of them that can be
// told apart.
class PointLayers {
 public:
  void update(const ViewState& state);
  const Bounds& bounds() const { return bounds_; }  // of all points, local frame
  bool empty() const { return layers_.empty(); }

  // `half`: half as fine; `quick`: in a quarter of the time.
  void draw(const ViewState& state, const PointLens& lens, int width, int height, bool half, bool quick);
  bool pending() const { return !layers_.empty() && (drawn_ < wanted_ || reading()); }
  // Adds some; false: nothing came within a moment.
  bool refine();
  const PointPicture& picture();  // as it is now
  std::string trouble() const;    // why points cannot be read; "" while they can

 private:
  struct Layer {
    std::shared_ptr<const Cloud> cloud;
    std::shared_ptr<const CloudPaint> paint;  // null: its own colours
    Eigen::Matrix4d local_from_cloud;
    PackedPoints points;                // of a cloud that is in memory
    std::unique_ptr<CloudNodes> nodes;  // of another one
  };
  struct Part {
    std::shared_ptr<const PackedPoints> points;
    PointRun run;  // what of it has been drawn: [0, first)
    std::size_t wanted = 0;
  };
  void show(std::shared_ptr<const Cloud> cloud, std::shared_ptr<const CloudPaint> paint,
            const Eigen::Matrix4d& local_from_cloud, std::vector<std::unique_ptr<Layer>>& before);
  void begin();
  void gather();
  void gatherNodes(const Layer& layer);
  void addPart(const Layer& layer, std::shared_ptr<const PackedPoints> points, const Eigen::Vector3d& origin_m,
               double gap_px);
  std::uint64_t affordable() const;  // points, in one picture
  void drawEvenly();
  void drawSome(std::uint64_t points);
  bool reading() const;

  std::vector<std::unique_ptr<Layer>> layers_;
  Bounds bounds_;
  Splatter splatter_;
  PointPicture shaded_;
  // Of the picture that is drawn.
  std::vector<Part> parts_;
  std::vector<ClipPlane> kept_;
  Camera camera_;
  PointLens lens_;
  int width_ = 0, height_ = 0, size_px_ = 2;
  bool enlarged_ = false;  // some points are larger than they are to be, until finer ones are there
  bool shade_ = false, quick_ = false;
  std::uint64_t drawn_ = 0, wanted_ = 0;
  double point_s_ = 10e-9;  // what a point takes, as measured
};

}  // namespace standpoint
