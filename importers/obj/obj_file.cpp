// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/obj_file.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

constexpr std::size_t kPiece = 4U << 20U;

// Where a chunk's parts begin in the whole file.
struct Base {
  std::size_t position = 0, texture = 0, corner = 0, face = 0, line = 1;
};

class Joiner {
 public:
  Joiner(std::vector<ObjChunk>& chunks, const std::string& name) : chunks_(chunks), name_(name) {}

  Result<ObjFile> join() {
    countBases();
    TRY(checkIndices());
    for (const auto& chunk : chunks_) {
      has_colours_ |= !chunk.colours.empty();
      has_texture_ |= !chunk.texture_corners.empty();
      for (const auto& c : chunk.colours) out_.colours_were_bytes |= c.maxCoeff() > 1;
    }
    const Base& all = bases_.back();
    if (all.face >= UINT32_MAX) return failure(error(all.line, "more than 4294967294 faces"));
    out_.positions.resize(all.position);
    out_.texture_coordinates.resize(all.texture);
    out_.corners.resize(all.corner);
    out_.face_begins.resize(all.face + 1);
    out_.face_begins.back() = all.corner;
    if (has_colours_) out_.colours.resize(all.position);
    if (has_texture_) out_.texture_corners.resize(all.corner);
    std::vector<ObjTally> wrong_texture(chunks_.size());
    tbb::parallel_for(std::size_t{0}, chunks_.size(),
                      [&](std::size_t i) { copy(chunks_[i], bases_[i], wrong_texture[i]); });
    TRY(checkVertices());
    for (std::size_t i = 0; i < chunks_.size(); ++i) copyWords(chunks_[i], bases_[i], wrong_texture[i]);
    return std::move(out_);
  }

 private:
  Error error(std::size_t line, std::string message) const {
    return {ErrorKind::unusable, std::move(message), name_ + " line " + std::to_string(line)};
  }

  void countBases() {
    bases_.emplace_back();
    for (const auto& chunk : chunks_) {
      const Base& b = bases_.back();
      bases_.push_back({b.position + chunk.positions.size(), b.texture + chunk.texture_coordinates.size(),
                        b.corner + chunk.corners.size(), b.face + chunk.face_ends.size(), b.line + chunk.lines});
    }
  }

  // The first fault in the order of the file; a wrong index is one of the chunk that has it.
  Result<void> checkIndices() const {
    const auto count = static_cast<std::int64_t>(bases_.back().position);
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
      const auto& chunk = chunks_[i];
      const auto before = static_cast<std::int64_t>(bases_[i].position);
      if (chunk.fault) return failure(error(bases_[i].line + chunk.fault->line, chunk.fault->message));
      if (before > kMaxObjIndex) return failure(error(bases_[i].line, "more than 1000000000 vertices"));
    }
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
      const auto& [largest, lowest] = std::pair(chunks_[i].largest, chunks_[i].lowest);
      const auto before = static_cast<std::int64_t>(bases_[i].position);
      if (lowest.value + before < 0)
        return failure(
            error(bases_[i].line + lowest.line, "refers to vertex " + std::to_string(lowest.written) + ", but only " +
                                                    std::to_string(lowest.preceding + before) + " precede it"));
      if (largest.value > count)
        return failure(error(bases_[i].line + largest.line, "refers to vertex " + std::to_string(largest.written) +
                                                                ", but there are " + std::to_string(count)));
    }
    return {};
  }

  // The first vertex that cannot be used and that a face uses.
  Result<void> checkVertices() const {
    if (std::all_of(chunks_.begin(), chunks_.end(), [](const ObjChunk& c) { return c.bad_vertices.empty(); }))
      return {};
    std::vector<bool> used(out_.positions.size());
    for (const auto index : out_.corners) used[index] = true;
    for (std::size_t i = 0; i < chunks_.size(); ++i)
      for (const auto& bad : chunks_[i].bad_vertices)
        if (used[bases_[i].position + bad.index]) return failure(error(bases_[i].line + bad.line, bad.why));
    return {};
  }

  void copy(ObjChunk& chunk, const Base& base, ObjTally& wrong_texture) {
    std::copy(chunk.positions.begin(), chunk.positions.end(),
              out_.positions.begin() + static_cast<std::ptrdiff_t>(base.position));
    std::copy(chunk.texture_coordinates.begin(), chunk.texture_coordinates.end(),
              out_.texture_coordinates.begin() + static_cast<std::ptrdiff_t>(base.texture));
    const auto before = static_cast<std::int64_t>(base.position);
    for (std::size_t i = 0; i < chunk.corners.size(); ++i)
      out_.corners[base.corner + i] = static_cast<std::uint32_t>(decodeIndex(chunk.corners[i], before));
    std::uint64_t begin = base.corner;
    for (std::size_t i = 0; i < chunk.face_ends.size(); ++i) {
      out_.face_begins[base.face + i] = begin;
      begin = base.corner + chunk.face_ends[i];
    }
    if (has_texture_) copyTexture(chunk, base, wrong_texture);
    if (has_colours_) copyColours(chunk, base);
    chunk.positions = {};  // the memory is wanted
    chunk.corners = {};
    chunk.texture_corners = {};
    chunk.texture_coordinates = {};
  }

  // A texture coordinate that is not there costs a corner its paint and not the model its face.
  void copyTexture(const ObjChunk& chunk, const Base& base, ObjTally& wrong) {
    const auto count = static_cast<std::int64_t>(out_.texture_coordinates.size()),
               before = static_cast<std::int64_t>(base.texture);
    for (std::size_t i = 0; i < chunk.corners.size(); ++i) {
      auto& to = out_.texture_corners[base.corner + i] = kNoTextureCorner;
      if (i >= chunk.texture_corners.size() || chunk.texture_corners[i] == kNoObjIndex) continue;
      const auto index = decodeIndex(chunk.texture_corners[i], before);
      if (index >= 0 && index < count)
        to = static_cast<std::uint32_t>(index);
      else if (wrong.count++ == 0)
        wrong.first_line = lineInChunk(chunk, i);
    }
  }

  static std::size_t lineInChunk(const ObjChunk& chunk, std::size_t corner) {
    const auto face = static_cast<std::uint32_t>(
        std::upper_bound(chunk.face_ends.begin(), chunk.face_ends.end(), corner) - chunk.face_ends.begin());
    const auto run =
        std::upper_bound(chunk.face_lines.begin(), chunk.face_lines.end(), std::pair(face, UINT32_MAX)) - 1;
    return run->second + (face - run->first);
  }

  void copyColours(const ObjChunk& chunk, const Base& base) {
    const float scale = out_.colours_were_bytes ? 1 : 255;
    for (std::size_t i = 0; i < bases_[static_cast<std::size_t>(&base - bases_.data()) + 1].position - base.position;
         ++i) {
      auto& to = out_.colours[base.position + i] = {255, 255, 255, 255};
      if (i >= chunk.colours.size() || !chunk.colours[i].allFinite()) continue;
      for (int k = 0; k < 3; ++k)
        to[static_cast<std::size_t>(k)] =
            static_cast<std::uint8_t>(std::lround(std::clamp(chunk.colours[i][k] * scale, 0.0F, 255.0F)));
    }
  }

  void copyWords(ObjChunk& chunk, const Base& base, const ObjTally& wrong_texture) {
    for (auto& event : chunk.events) {
      event.face += static_cast<std::uint32_t>(base.face);
      event.line += base.line;
      out_.events.push_back(std::move(event));
    }
    for (const auto& [face, line] : chunk.face_lines) out_.face_lines.emplace_back(base.face + face, base.line + line);
    auto tallies = chunk.tallies;
    if (wrong_texture.count > 0) tallies[std::string(kWrongTexture)] = wrong_texture;
    for (const auto& [what, tally] : tallies) {
      auto& sum = out_.tallies[what];
      if (sum.count == 0) sum.first_line = base.line + tally.first_line;
      sum.count += tally.count;
    }
    out_.known_statements += chunk.known_statements;
    chunk = {};
  }

  std::vector<ObjChunk>& chunks_;
  const std::string& name_;
  std::vector<Base> bases_;
  ObjFile out_;
  bool has_colours_ = false, has_texture_ = false;
};

}  // namespace

std::size_t ObjFile::lineOf(std::size_t face) const {
  const auto run =
      std::upper_bound(face_lines.begin(), face_lines.end(), std::pair(static_cast<std::uint32_t>(face), SIZE_MAX)) - 1;
  return run->second + (face - run->first);
}

Result<ObjFile> readObjFile(const FileBytes& bytes, const std::string& name, std::size_t piece, Progress& progress) {
  std::vector<ObjChunk> chunks((bytes.size() + piece - 1) / piece);
  std::vector<Error> unread(chunks.size());
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stop = false;
  tbb::parallel_for(
      std::size_t{0}, chunks.size(),
      [&](std::size_t i) {
        if (stop || progress.cancelled()) return;
        auto text = textPiece(bytes, i * piece, piece);
        if (!text) {
          unread[i] = text.error();
          stop = true;
          return;
        }
        std::string_view content = *text;
        if (i == 0 && content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
        if (!content.empty()) chunks[i] = parseObjChunk(content);
        progress.advance(0.6 * static_cast<double>(++done) / static_cast<double>(chunks.size()));
      },
      tbb::simple_partitioner());
  TRY(progress.check());
  for (const auto& error : unread)
    if (!error.message.empty()) return failure(error);
  return Joiner(chunks, name).join();
}

Result<ObjFile> readObjFile(const FileBytes& bytes, const std::string& name, Progress& progress) {
  return readObjFile(bytes, name, kPiece, progress);
}

}  // namespace standpoint
