// SPDX-License-Identifier: GPL-3.0-or-later
// All of OpenMesh's decimation is compiled here.
#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_cast.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <fmt/format.h>

#include "optimizer/simplify/engines/engine.h"
#include "optimizer/simplify/engines/held_shape.h"

namespace standpoint {

namespace {

namespace decimater = OpenMesh::Decimater;

struct Traits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Info = decimater::CollapseInfoT<HalfEdges>;

constexpr double kAreaOfQuadrics = 3;  // OpenMesh gives each corner a triangle's whole area, we a third of it
constexpr float kLargestTurnDeg = 78;  // of a triangle in one step

std::uint32_t indexOf(HalfEdges::VertexHandle v) { return static_cast<std::uint32_t>(v.idx()); }

// OpenMesh's quadrics, with planes of ours along borders and lines, which it does not know; notes each collapse.
class HeldQuadricModule : public decimater::ModQuadricT<HalfEdges> {
 public:
  using Handle = decimater::ModHandleT<HeldQuadricModule>;
  explicit HeldQuadricModule(HalfEdges& mesh) : ModQuadricT(mesh) {}
  void hold(HeldShape& held, CollapseRecorder& recorder) {
    held_ = &held;
    recorder_ = &recorder;
  }

  float collapse_priority(const Info& info) override {
    const auto from = indexOf(info.v0), to = indexOf(info.v1);
    const auto hold = held_->holds[from];
    if (hold == Hold::fixed || (hold == Hold::line && !alongLine(info))) return ILLEGAL_COLLAPSE;
    Quadric held = held_->lines[from];
    held += held_->lines[to];
    held += held_->borders[from];
    held += held_->borders[to];
    const float value = ModQuadricT::collapse_priority(info);
    return value < 0 ? value : value + static_cast<float>(kAreaOfQuadrics * held({info.p1[0], info.p1[1], info.p1[2]}));
  }

  void postprocess_collapse(const Info& info) override {
    ModQuadricT::postprocess_collapse(info);
    const auto triangles =
        static_cast<std::uint32_t>(info.fl.is_valid()) + static_cast<std::uint32_t>(info.fr.is_valid());
    recorder_->record(indexOf(info.v1), indexOf(info.v0), triangles, {info.p1[0], info.p1[1], info.p1[2]});
  }

 private:
  bool alongLine(const Info& info) const {
    return info.fl.is_valid() && info.fr.is_valid() &&
           held_->charts[static_cast<std::size_t>(info.fl.idx())] !=
               held_->charts[static_cast<std::size_t>(info.fr.idx())];
  }

  HeldShape* held_ = nullptr;
  CollapseRecorder* recorder_ = nullptr;
};

class Watcher : public decimater::Observer {
 public:
  explicit Watcher(const Progress& progress) : Observer(256), progress_(progress) {}
  void notify(size_t) override {}
  bool abort() const override { return progress_.cancelled(); }

 private:
  const Progress& progress_;
};

Result<void> build(const HeldShape& held, HalfEdges& mesh) {
  [[maybe_unused]] static const bool silent = (omerr().disable(), true);  // what it refuses is an error here
  mesh.reserve(held.positions.size(), held.triangles.size() * 3 / 2, held.triangles.size());
  for (const auto& p : held.positions) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& t : held.triangles) {
    const auto face =
        mesh.add_face(HalfEdges::VertexHandle(static_cast<int>(t[0])), HalfEdges::VertexHandle(static_cast<int>(t[1])),
                      HalfEdges::VertexHandle(static_cast<int>(t[2])));
    if (!face.is_valid()) return failure(ErrorKind::unusable, "OpenMesh cannot connect its triangles");
  }
  mesh.update_face_normals();
  return {};
}

}  // namespace

Result<std::vector<Collapse>> simplifyByOpenMesh(const Shape& shape, const EngineTarget& target,
                                                 const Progress& progress) {
  auto held = heldShapeOf(shape, target.stays);
  TRY(checkReachable(held, target.triangles));
  CollapseRecorder recorder(held);
  try {
    HalfEdges mesh;
    TRY(build(held, mesh));
    decimater::DecimaterT<HalfEdges> decimation(mesh);
    HeldQuadricModule::Handle quadrics;
    decimation.add(quadrics);
    decimation.module(quadrics).hold(held, recorder);
    decimater::ModNormalFlippingT<HalfEdges>::Handle turning;
    decimation.add(turning);
    decimation.module(turning).set_max_normal_deviation(kLargestTurnDeg);
    decimater::ModHausdorffT<HalfEdges>::Handle distance;
    if (target.max_deviation_m < shape.diagonal()) {
      decimation.add(distance);
      decimation.module(distance).set_tolerance(target.max_deviation_m);
    }
    if (!decimation.initialize()) return failure(ErrorKind::internal, "OpenMesh refuses its modules");
    Watcher watcher(progress);
    decimation.set_observer(&watcher);
    decimation.decimate_to_faces(0, target.triangles);
  } catch (const std::exception& e) {
    return failure(ErrorKind::unusable, std::string("OpenMesh: ") + e.what());
  }
  TRY(progress.check());
  if (recorder.triangles() > target.triangles)
    return failure(ErrorKind::unusable, fmt::format("OpenMesh keeps {} triangles, {} are requested",
                                                    recorder.triangles(), target.triangles));
  return recorder.take();
}

}  // namespace standpoint
