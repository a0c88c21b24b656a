// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>
#include <functional>

#include "pointclouds/e57/crc32c.h"
#include "pointclouds/e57/e57.h"
#include "pointclouds/ptx/ptx.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_picture.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

using testing::KeptScans;
using testing::madeUpHeader;
using testing::writeScan;

Result<void> writePictured(CloudWriter& writer) {
  return writer.begin(madeUpHeader({2, 2, false, false, "P"}))
      .and_then([&] { return writer.picture(testing::madeUpPicture(StationPicture::Projection::spherical, 600)); })
      .and_then([&] { return writer.end(); });
}

std::string smallFile(const std::filesystem::path& file) {
  auto writer = cloudFormatFor(file)->writer(file);
  const auto done = writeScan(**writer, madeUpHeader({12, 9, true, file.extension() != ".ptx", "S", true}))
                        .and_then([&] { return file.extension() == ".e57" ? writePictured(**writer) : Result<void>{}; })
                        .and_then([&] { return (*writer)->close(); });
  EXPECT_TRUE(done.has_value()) << describe(done.error());
  return testing::bytesOf(file);
}

// So that a mutation reaches what lies behind the checksums.
void seal(std::string& file) {
  for (std::size_t page = 0; page + 1024 <= file.size(); page += 1024) {
    const std::uint32_t c = crc32c({reinterpret_cast<const std::uint8_t*>(file.data()) + page, 1020});
    for (int i = 0; i < 4; ++i) file[page + 1020 + static_cast<std::size_t>(i)] = static_cast<char>(c >> (24 - 8 * i));
  }
}

void mutate(std::string& bytes, std::uint32_t round) {
  const auto r = philox({99, 0}, round, 0, 0);
  for (std::uint32_t k = 0; k <= r[0] % 4; ++k) {
    const auto q = philox({99, 1}, round, k, 0);
    const std::size_t at = q[0] % bytes.size();
    constexpr char kEdges[] = {0,   1,   127, static_cast<char>(128), static_cast<char>(255), '0', '9', '-', 'e',
                               '<', '"', '\n'};
    bytes[at] = q[1] % 2 ? static_cast<char>(q[2]) : kEdges[q[2] % sizeof kEdges];
  }
}

// An answer, whichever: points that the file can hold, or an error with a place. Crashes show in any build, wrong
// memory and arithmetic in the one with sanitizers.
void expectAnAnswer(const std::filesystem::path& file) {
  KeptScans kept;
  const auto read = readAll(file, kept);
  EXPECT_TRUE(read || !read.error().source.empty()) << read.error().message;
  const auto told = cloudFormatFor(file)->info(file);
  EXPECT_TRUE(told || !told.error().source.empty()) << told.error().message;
}

// Replaces text in the XML, which must keep its length, and mends the checksums.
void edit(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string bytes = testing::bytesOf(file);
  ASSERT_EQ(from.size(), to.size());
  std::size_t hits = 0;
  // The text may straddle a checksum: this looks at the payload alone.
  std::string payload;
  for (std::size_t page = 0; page < bytes.size(); page += 1024) payload += bytes.substr(page, 1020);
  for (std::size_t at = payload.find(from); at != std::string::npos; at = payload.find(from, at + 1), ++hits)
    payload.replace(at, to.size(), to);
  ASSERT_GT(hits, 0u) << from;
  for (std::size_t page = 0; page < bytes.size(); page += 1024)
    bytes.replace(page, 1020, payload.substr(page / 1024 * 1020, 1020));
  seal(bytes);
  testing::putBytes(file, bytes);
}

TEST(HostileE57, IsAnsweredWhateverByteChanged) {
  const TemporaryFolder folder;
  const std::string good = smallFile(folder / "good.e57");
  for (std::uint32_t round = 0; round < 4000; ++round) {
    std::string bad = good;
    mutate(bad, round);
    if (round % 8 != 0) seal(bad);
    testing::putBytes(folder / "bad.e57", bad);
    expectAnAnswer(folder / "bad.e57");
  }
}

TEST(HostilePtx, IsAnsweredWhateverByteChanged) {
  const TemporaryFolder folder;
  const std::string good = smallFile(folder / "good.ptx");
  for (std::uint32_t round = 0; round < 4000; ++round) {
    std::string bad = good;
    mutate(bad, round);
    testing::putBytes(folder / "bad.ptx", bad);
    expectAnAnswer(folder / "bad.ptx");
  }
}

TEST(HostileClouds, AreAnsweredWhateverByteChanged) {
  const TemporaryFolder folder;
  for (const char* name : {"s.las", "s.ply", "s.pcd", "s.csv", "s.pts", "s.xyz"}) {
    const std::string good = smallFile(folder / name);
    for (std::uint32_t round = 0; round < 1500; ++round) {
      std::string bad = good;
      // Half of the changes in the header, where they matter most.
      if (round % 2 == 0) {
        mutate(bad, round);
      } else {
        std::string head = bad.substr(0, std::min<std::size_t>(bad.size(), 1500));
        mutate(head, round);
        bad.replace(0, head.size(), head);
      }
      testing::putBytes(folder / name, bad);
      expectAnAnswer(folder / name);
    }
  }
}

TEST(HostilePcd, IsRefusedAtOnceWithTheReason) {
  const TemporaryFolder folder;
  const auto file = [](const std::string& lines) {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + lines;
  };
  const std::pair<std::string, const char*> faults[] = {
      {file("WIDTH 1000000000\nHEIGHT 1000\nPOINTS 1000000000000\nDATA binary\nabc"), "no space for 1000000000000"},
      {file("WIDTH 99999999999999999999\nDATA binary\n"), "WIDTH is not a point count"},
      {file("WIDTH 1099511627776\nHEIGHT 1099511627776\nDATA binary\n"), "too large"},
      {file("WIDTH 2\nHEIGHT 1\nPOINTS 3\nDATA ascii\n1 2 3\n1 2 3\n1 2 3\n"), "POINTS is not"},
      {file("WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 0 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3\n"), "VIEWPOINT"},
      {file("WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary_compressed\n123456789012"), "compressed"},
      {"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4\n", "2 entries for 3"},
      {"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 4000000000\n", "no size or count"},
      {"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n", "no known type"},
      {"# .PCD v0.7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2\n", "x y z"},
      {"no such file\n", "unknown PCD header entry 'no'"}};
  for (const auto& [text, says] : faults) {
    testing::putBytes(folder / "bad.pcd", text);
    KeptScans kept;
    const auto read = readAll(folder / "bad.pcd", kept);
    ASSERT_FALSE(read.has_value()) << says;
    EXPECT_EQ(read.error().kind, ErrorKind::unusable);
    EXPECT_THAT(describe(read.error()),
                ::testing::AllOf(::testing::StartsWith("bad.pcd line"), ::testing::HasSubstr(says)));
  }
}

// The points of a file are worth having without a picture whose blob is wrong.
TEST(HostileE57, WithAPictureOutsideOfItselfKeepsItsPoints) {
  const TemporaryFolder folder;
  smallFile(folder / "s.e57");
  edit(folder / "s.e57", "length=\"600\"", "length=\"999\"");
  KeptScans kept;
  const auto longer = readAll(folder / "s.e57", kept);  // reaches into the next section: nobody can tell
  ASSERT_OK(longer);
  for (const auto& [from, to] :
       {std::pair("pngImage type=\"Blob\" fileOffset=\"", "pngImage type=\"Blob\" fileOffset=\"9"),
        std::pair("sphericalRepresentation", "cylindricRepresentation")}) {
    smallFile(folder / "s.e57");
    const std::string wanted = from;
    std::string other = to;
    if (other.size() > wanted.size()) other = "pngImage type=\"Bl0b\" filOOffset=\"";
    edit(folder / "s.e57", wanted, other);
    KeptScans found;
    const auto report = readAll(folder / "s.e57", found);
    ASSERT_OK(report);
    EXPECT_EQ(report->losses(), 1u) << testing::said(*report);
    EXPECT_EQ(found.scans.size(), 2u);
  }
}

TEST(HostileClouds, CutAnywhereAreErrorsWithAPlace) {
  const TemporaryFolder folder;
  for (const char* name : {"s.e57", "s.ptx", "s.pts", "s.ply", "s.pcd"}) {
    const std::string good = smallFile(folder / name);
    // Nobody can tell that the last number of a text has lost a digit, or the last point its colour.
    const bool text = std::string(name).ends_with("ptx") || std::string(name).ends_with("pts");
    const std::size_t end = text ? good.rfind('\n', good.size() - 2) : good.size();
    for (std::size_t size = 0; size < end; size += 1 + size / 20) {
      testing::putBytes(folder / name, good.substr(0, size));
      KeptScans kept;
      const auto read = readAll(folder / name, kept);
      ASSERT_FALSE(read.has_value()) << name << " cut to " << size;
      EXPECT_EQ(read.error().kind, ErrorKind::unusable);
      EXPECT_THAT(read.error().source, ::testing::StartsWith(name));
    }
  }
}

TEST(HostileE57, WithAWrongChecksumNamesThePage) {
  const TemporaryFolder folder;
  std::string bytes = smallFile(folder / "s.e57");
  bytes[1024 + 17] = static_cast<char>(bytes[1024 + 17] ^ 4);
  testing::putBytes(folder / "s.e57", bytes);
  KeptScans kept;
  const auto read = readAll(folder / "s.e57", kept);
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(describe(read.error()),
              ::testing::AllOf(::testing::HasSubstr("s.e57 page 1"), ::testing::HasSubstr("checksum")));
}

struct Edit {
  const char *from, *to, *says;
};

TEST(HostileE57, ThatClaimsTooMuchIsRefusedAtOnce) {
  const TemporaryFolder folder;
  const Edit edits[] = {
      {"fileOffset=\"48\"", "fileOffset=\"99\"", "no CompressedVector"},
      {"<e57Root", "<e57Rood", "XML"},
      {"recordCount=", "recordQount=", "missing"},
      {"cartesianX", "cartesianQ", "neither cartesian nor spherical"},
      {"precision=\"single\"/>\n<cartesianY", "precision=\"double\"/>\n<cartesianY", "section ends after"}};
  for (const Edit& e : edits) {
    smallFile(folder / "s.e57");
    edit(folder / "s.e57", e.from, e.to);
    KeptScans kept;
    const auto read = readAll(folder / "s.e57", kept);
    ASSERT_FALSE(read.has_value()) << e.from;
    EXPECT_THAT(read.error().message, ::testing::HasSubstr(e.says)) << e.from;
  }
}

TEST(HostileE57, WithoutPointsAndWithoutIndexBoundsHasNoGrid) {
  const TemporaryFolder folder;
  const std::string good = smallFile(folder / "s.e57");
  const std::string attribute = "recordCount=\"";
  for (std::size_t at = good.find(attribute); at != std::string::npos; at = good.find(attribute, at + 1)) {
    const std::size_t digits = good.find('"', at + attribute.size()) - at - attribute.size();
    edit(folder / "s.e57", good.substr(at, attribute.size() + digits + 1), attribute + std::string(digits, '0') + '"');
  }
  edit(folder / "s.e57", "rowMaximum", "rowMaximun");
  KeptScans kept;
  const auto read = readAll(folder / "s.e57", kept);
  ASSERT_TRUE(read.has_value()) << describe(read.error());
  ASSERT_FALSE(kept.scans.empty());
  EXPECT_EQ(kept.scans[0].header.rows, 0u);
  EXPECT_EQ(kept.scans[0].header.columns, 0u);
}

TEST(HostilePtx, WithAGridLargerThanTheFileIsRefusedAtOnce) {
  const TemporaryFolder folder;
  testing::putBytes(
      folder / "huge.ptx",
      "1000000000\n1000000000\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0.5\n");
  KeptScans kept;
  const auto read = readAll(folder / "huge.ptx", kept);
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(describe(read.error()), ::testing::HasSubstr("huge.ptx line 2"));
  EXPECT_TRUE(kept.scans.empty());
}

TEST(HostilePtx, NamesTheLineThatIsNoPoint) {
  const TemporaryFolder folder;
  std::string text = smallFile(folder / "s.ptx");
  std::size_t at = 0;
  for (int line = 1; line < 40; ++line) at = text.find('\n', at) + 1;
  text.replace(at, 3, "x y");
  testing::putBytes(folder / "s.ptx", text);
  KeptScans kept;
  const auto read = readAll(folder / "s.ptx", kept);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().source, "s.ptx line 40");
}

}  // namespace
}  // namespace standpoint
