// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <span>
#include <vector>

#include "pointclouds/e57/crc32c.h"
#include "pointclouds/octree/octree_file.h"
#include "pointclouds/octree/octree_layout.h"
#include "tests/fuzz/fuzz_file.h"

namespace {

using namespace standpoint;

// The part of the bytes that the head says, as far as there are any.
std::span<const std::uint8_t> part(const std::vector<std::uint8_t>& bytes, std::uint64_t at, std::uint64_t count) {
  if (at > bytes.size() || count > bytes.size() - at) return {};
  return {bytes.data() + at, count};
}

// The checksums of the tables and of the nodes are mended, those of the head last: else nothing that the fuzzer changes
// gets behind them.
void mend(std::vector<std::uint8_t>& bytes) {
  octree::Head head;
  if (bytes.size() < sizeof head) return;
  std::memcpy(&head, bytes.data(), sizeof head);
  const auto rows = std::min<std::uint64_t>(head.nodes, bytes.size() / sizeof(octree::TableNode));
  for (std::uint64_t i = 0; i < rows; ++i) {
    const auto at = head.nodes_at + i * sizeof(octree::TableNode);
    if (part(bytes, at, sizeof(octree::TableNode)).empty()) break;
    octree::TableNode node;
    std::memcpy(&node, bytes.data() + at, sizeof node);
    node.checksum = crc32c(part(bytes, node.offset, std::uint64_t{node.points} * sizeof(CloudPoint)));
    std::memcpy(bytes.data() + at, &node, sizeof node);
  }
  head.nodes_checksum = crc32c(part(bytes, head.nodes_at, rows * sizeof(octree::TableNode)));
  head.tables_checksum = crc32c(part(bytes, head.tables_at, head.tables_bytes));
  std::memcpy(bytes.data(), &head, sizeof head);
  head.checksum = crc32c({bytes.data(), offsetof(octree::Head, checksum)});
  std::memcpy(bytes.data(), &head, sizeof head);
}

void fail(const char* why) {
  std::fprintf(stderr, "%s\n", why);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  mend(bytes);
  const auto octree = OctreeFile::open(fuzz::fileOf(bytes.data(), bytes.size(), ".octree"));
  if (!octree) {
    if (octree.error().source.empty()) fail("an error names no place");
    return 0;
  }
  const auto& header = (*octree)->header();
  for (std::size_t i = 0; i < (*octree)->nodes().size(); ++i) {
    const auto points = (*octree)->read(i);
    if (!points && points.error().source.empty()) fail("an error of a node names no place");
    if (!points) continue;
    for (const auto& point : *points)
      if (point.station >= header.stations.size()) fail("a point is of no scan");
  }
  return 0;
}
