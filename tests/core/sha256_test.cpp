// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sha256.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

// Examples of NIST: "abc", the empty text, two blocks, a million letters.
TEST(Sha256, GivesTheDigestsOfThePublishedExamples) {
  EXPECT_EQ(sha256Of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256Of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256Of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256Of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, IsTheSameHoweverTheBytesArePiecedTogether) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>(i);
  const auto whole = sha256Of(text);
  for (const std::size_t piece : {1U, 7U, 63U, 64U, 65U, 130U}) {
    Sha256 sum;
    for (std::size_t at = 0; at < text.size(); at += piece)
      sum.add({reinterpret_cast<const std::uint8_t*>(text.data()) + at, std::min(piece, text.size() - at)});
    EXPECT_EQ(sum.hex(), whole) << piece;
  }
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const TemporaryFolder folder;
  Progress progress;
  EXPECT_EQ(sha256OfFile(folder.write("a", "abc"), progress).value(), sha256Of("abc"));
  const auto missing = sha256OfFile(folder / "b", progress);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::file_system);
  EXPECT_EQ(missing.error().source, (folder / "b").string());
}

}  // namespace
}  // namespace standpoint
