// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/model_pieces.h"

#include <algorithm>
#include <array>
#include <utility>

#include <vtkProperty.h>

namespace standpoint {

namespace {

constexpr std::uint64_t kMostEdges = 1500000;  // triangles; above that the lines would be a grey fog and take long
// What is merged and handed to the graphics library in 20 to 40 ms on one processor.
constexpr std::uint64_t kAtOnce = 60000;
// Not less, or drawing many small actors takes longer than drawing their triangles.
constexpr std::uint64_t kPiece = 30000, kMostPieces = 64;

bool showsModel(const ViewState& state) { return state.environment && !state.shapes && !state.cloud; }

bool sameShown(const std::shared_ptr<const HiddenProducts>& a, const std::shared_ptr<const HiddenProducts>& b,
               std::uint32_t product) {
  const auto hidden = [product](const auto& of) { return of && product < of->size() && (*of)[product] != 0; };
  return hidden(a) == hidden(b);
}

}  // namespace

std::vector<InstanceRange> rangesOf(const Environment& environment, std::uint64_t triangles) {
  std::array<std::vector<InstanceRange>, kFaceRanks> ranges;
  std::array<std::uint64_t, kFaceRanks> counts{};
  for (std::size_t i = 0; i < environment.instances.size(); ++i) {
    const auto& instance = environment.instances[i];
    const auto more = environment.meshes[instance.mesh]->triangles.size();
    const int rank = faceRank(environment.products[instance.product]);
    auto& of_rank = ranges[static_cast<std::size_t>(rank)];
    auto& count = counts[static_cast<std::size_t>(rank)];
    if (of_rank.empty() || (count > 0 && count + more > triangles)) {
      of_rank.push_back({i, i, rank});
      count = 0;
    }
    count += more;
    of_rank.back().end = i + 1;
  }
  std::vector<InstanceRange> all;
  for (const auto& of_rank : ranges) all.insert(all.end(), of_rank.begin(), of_rank.end());
  return all;
}

ModelPieces::Look ModelPieces::lookOf(const ViewState& state) {
  return {state.hidden, state.materials, state.deviation, state.colour, state.wavelength_nm, state.doors != nullptr};
}

void ModelPieces::plan(const ViewState& state) {
  forEachLayer([this](Layer& layer) { renderer_->RemoveActor(layer.actor); });
  pieces_.clear();
  edge_cache_.forgetLost();
  environment_ = state.environment;
  if (!environment_) return;
  const auto each = std::max<std::uint64_t>(kPiece, triangleCount(*environment_) / kMostPieces);
  for (const auto& range : rangesOf(*environment_, each)) {
    auto& piece = *pieces_.emplace_back(std::make_unique<Piece>());
    piece.range = range;
    for (auto i = range.first; i < range.end; ++i)
      if (range.holds(*environment_, i))
        piece.triangles += environment_->meshes[environment_->instances[i].mesh]->triangles.size();
    for (Layer* layer : {&piece.opaque, &piece.transparent, &piece.graded, &piece.graded_transparent})
      layer->drawSurface(depthOffsetOf(range.rank));
    piece.transparent.actor->ForceTranslucentOn();
    piece.graded_transparent.actor->ForceTranslucentOn();
    piece.edges.drawLines({0.07, 0.08, 0.10}, 0.55, line_width_);
    setVisible(piece, false, false);
  }
}

bool ModelPieces::update(const ViewState& state) {
  const bool others = environment_ != state.environment;
  if (others) plan(state);
  building_ = false;
  const bool model = showsModel(state);
  const bool edges = model && state.edges && triangleCount(*environment_) <= kMostEdges;
  const Look look = lookOf(state);
  std::uint64_t made = 0;
  for (const auto& piece : pieces_) {
    const bool comes = model && !piece->look;
    if (model && piece->look != look) {
      const bool same_triangles = shows(*piece, state, look);
      if (same_triangles && repaint(*piece, state)) {
        piece->look = look;
      } else if (made == 0 || made + piece->triangles <= kAtOnce) {
        made += piece->triangles;
        make(*piece, state);
        piece->look = look;
        piece->has_edges = piece->has_edges && same_triangles;
      } else {
        building_ = true;
      }
    }
    if (edges && comes)
      building_ = true;  // its edges come with the next picture: this one has enough to make
    else if (edges && piece->look && !piece->has_edges)
      showEdges(*piece, state);
    setVisible(*piece, model, edges);
  }
  return others;
}

// The same products as it is to show, and the same triangles of them.
bool ModelPieces::shows(const Piece& piece, const ViewState& state, const Look& look) {
  if (!piece.look || piece.look->doors_apart != look.doors_apart) return false;
  if (piece.look->hidden == look.hidden) return true;
  for (auto i = piece.range.first; i < piece.range.end; ++i)
    if (piece.range.holds(*state.environment, i) &&
        !sameShown(piece.look->hidden, look.hidden, state.environment->instances[i].product))
      return false;
  return true;
}

bool ModelPieces::repaint(Piece& piece, const ViewState& state) {
  Look before = *piece.look;
  before.hidden = state.hidden;
  if (before == lookOf(state)) return true;  // nothing of it was hidden or shown
  const auto colours = mergeColours(state, piece.range);
  if (!colours || colours->runs != piece.runs) return false;
  piece.opaque.paint(colours->opaque);
  piece.transparent.paint(colours->transparent);
  return true;
}

void ModelPieces::make(Piece& piece, const ViewState& state) {
  const auto colours = mergeColours(state, piece.range);
  piece.runs = colours ? colours->runs : std::vector<std::uint32_t>();
  const auto merged = mergeVisible(state, piece.range);
  piece.opaque.show(merged.opaque);
  piece.transparent.show(merged.transparent);
  piece.graded.show(merged.graded);
  piece.graded_transparent.show(merged.graded_transparent);
  for (const auto& layer : piece.painted) renderer_->RemoveActor(layer->actor);
  piece.painted.clear();
  for (const auto& [key, painted] : merged.painted) {
    auto& layer = *piece.painted.emplace_back(std::make_unique<Layer>());
    layer.drawSurface(depthOffsetOf(piece.range.rank));
    layer.show(painted, textures_.of(environment_->images[static_cast<std::size_t>(key.first)]));
    renderer_->AddActor(layer.actor);
  }
}

void ModelPieces::showEdges(Piece& piece, const ViewState& state) {
  piece.edges.show(edge_cache_.edges(state, nullptr, piece.range));
  piece.has_edges = true;
}

void ModelPieces::setVisible(Piece& piece, bool model, bool edges) {
  for (Layer* layer : {&piece.opaque, &piece.transparent, &piece.graded, &piece.graded_transparent})
    layer->reveal(model);
  for (const auto& layer : piece.painted) layer->reveal(model);
  piece.edges.reveal(edges);
}

void ModelPieces::addSurfaces() const {
  for (const auto& piece : pieces_) {
    renderer_->AddActor(piece->opaque.actor);
    renderer_->AddActor(piece->graded.actor);
    for (const auto& layer : piece->painted) renderer_->AddActor(layer->actor);
  }
}

void ModelPieces::addTransparent() const {
  for (const auto& piece : pieces_) renderer_->AddActor(piece->transparent.actor);
  for (const auto& piece : pieces_) renderer_->AddActor(piece->graded_transparent.actor);
}

void ModelPieces::addEdges() const {
  for (const auto& piece : pieces_) renderer_->AddActor(piece->edges.actor);
}

void ModelPieces::setLineWidth(float pixels) {
  line_width_ = pixels;
  for (const auto& piece : pieces_) piece->edges.actor->GetProperty()->SetLineWidth(pixels);
}

void ModelPieces::spareEdges(bool spared) {
  for (const auto& piece : pieces_) piece->edges.spare(spared);
}

void ModelPieces::forEachLayer(const std::function<void(Layer&)>& act) {
  for (const auto& piece : pieces_) {
    for (Layer* layer :
         {&piece->opaque, &piece->transparent, &piece->graded, &piece->graded_transparent, &piece->edges})
      act(*layer);
    for (const auto& layer : piece->painted) act(*layer);
  }
}

}  // namespace standpoint
