// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The solid-modelling kernel of the importers: double precision, polygons with holes kept until the very end (a
// triangle explosion between steps is what kills Booleans). Knows nothing of IFC. All lengths in metres, angles in
// radians; work in the element's own frame, where coordinates are small and walls are axis-aligned.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/mesh.h"
#include "core/result.h"

namespace standpoint::geometry {

struct Tessellation {
  double chord_error_m = 0.001;           // sagitta at most this …
  double max_segment_angle_rad = 0.2095;  // … and no segment turns further
};
// Segments for an arc of that radius and sweep, from 1 to 4096 (a full circle gets a multiple of 4, so that its extreme
// points are on the bounds).
int segmentCount(double radius_m, double sweep_rad, const Tessellation& tessellation);

using Loop2 = std::vector<Eigen::Vector2d>;  // closed, the first point not repeated
struct Region2 {                             // outer counter-clockwise, holes clockwise; normalise() makes it so
  Loop2 outer;
  std::vector<Loop2> holes;
};
void normalise(Region2& region);  // orientation, repeated and collinear-spike points out
double area(const Region2& region);
// Polygon Booleans, robust for touching and overlapping input.
Result<std::vector<Region2>> difference(std::span<const Region2> a, std::span<const Region2> b);
Result<std::vector<Region2>> intersection(std::span<const Region2> a, std::span<const Region2> b);
Result<std::vector<Region2>> unite(std::span<const Region2> a);

struct Face {  // planar polygon, counter-clockwise seen from outside
  std::vector<std::uint32_t> outer;
  std::vector<std::vector<std::uint32_t>> holes;
  std::uint32_t tag = 0;  // carried through every operation: which item/style it came from
};
struct PolyMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Face> faces;
};

void append(PolyMesh& to, const PolyMesh& from);
void transform(PolyMesh& mesh, const Eigen::Affine3d& to_from);  // flips the faces when it mirrors
void setTag(PolyMesh& mesh, std::uint32_t tag);
double volume(const PolyMesh& mesh);
bool isClosed(const PolyMesh& mesh, double weld_m = 1e-6);
// Welds points closer than weld_m, drops degenerate faces, makes neighbours agree, and turns closed shells outward; a
// closed shell within a larger one and turned against it bounds a cavity, inward.
void orientOutward(PolyMesh& mesh, double weld_m = 1e-6);

// Solids. Profiles lie in the XY plane of their own frame.
// A profile that encloses nothing gives an empty mesh, and so does a taper between profiles of unequal point counts.
PolyMesh extrude(const Region2& profile, const Eigen::Vector3d& direction_unit, double depth_m);
PolyMesh extrudeTapered(const Region2& from, const Region2& to, const Eigen::Vector3d& direction_unit, double depth_m);
PolyMesh revolve(const Region2& profile, const Eigen::Vector3d& axis_point, const Eigen::Vector3d& axis_unit,
                 double angle_rad, const Tessellation& tessellation);
// A disk (or ring: inner_radius_m > 0) along a polyline, mitred at the corners. The normals of the two end faces may
// differ from the first and last chord, as where the polyline stands for an arc; zero: they do not.
struct EndNormals {
  Eigen::Vector3d start_unit = Eigen::Vector3d::Zero(), end_unit = Eigen::Vector3d::Zero();
};
PolyMesh sweepDisk(std::span<const Eigen::Vector3d> path, bool closed, double radius_m, double inner_radius_m,
                   const Tessellation& tessellation, const EndNormals& ends = {});
// A profile placed at each frame in turn (x, y of the profile along the frame's x, y), neighbours joined by quads or
// triangles; all profiles must have the same number of points, loop by loop. Ends capped unless closed.
Result<PolyMesh> loft(std::span<const Region2> profiles, std::span<const Eigen::Isometry3d> frames, bool closed);
PolyMesh box(const Eigen::Vector3d& size_m);                                            // one corner at the origin
PolyMesh cylinder(double radius_m, double height_m, const Tessellation& tessellation);  // base on XY
PolyMesh cone(double radius_m, double height_m, const Tessellation& tessellation);
PolyMesh sphere(double radius_m, const Tessellation& tessellation);
PolyMesh pyramid(double x_m, double y_m, double height_m);

// Keeps what lies below the plane n·p <= d (n unit) and closes the cut. Points within 1e-6 m of the plane count as on
// it. Nothing left is an empty mesh; an open surface stays open.
Result<PolyMesh> clip(const PolyMesh& mesh, const Eigen::Vector3d& normal_unit, double offset_m);

// host − all tools at once. First the 2D way (host and tools are extrusions along a common direction, which it finds
// out itself from the faces), for the tools that do not fit carve with everything snapped to 1e-6 m, then CGAL
// corefinement with all tools left joined. Nothing left is an empty mesh. A face of the result carries the tag of the
// face that it lies on: give the tools the host's tag where reveals should look like the host. The result's volume is
// checked: V(host) − V(tools) <= V <= V(host) within 1e-6 + 0.1 %; a result that fails is an error whose message says
// which way failed, so that the caller keeps the uncut body and reports it.
Result<PolyMesh> subtract(const PolyMesh& host, std::span<const PolyMesh> tools);
Result<PolyMesh> intersect(const PolyMesh& a, const PolyMesh& b);
Result<PolyMesh> unite(const PolyMesh& a, const PolyMesh& b);

// A planar polygon with holes → triangles that index the same points, `inner` ones too, which lie inside and off its
// edges. Robust for collinear points, touching holes, slight non-planarity and self-touching outlines; a polygon that
// cannot be triangulated gives no triangles and false.
bool triangulate(std::span<const Eigen::Vector3d> points, const Face& face, std::vector<Triangle>& triangles,
                 std::span<const std::uint32_t> inner = {});

struct TriangulatedMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> tag_of_triangle;
  std::uint32_t failed_faces = 0;
};
TriangulatedMesh triangulate(const PolyMesh& mesh);

}  // namespace standpoint::geometry
