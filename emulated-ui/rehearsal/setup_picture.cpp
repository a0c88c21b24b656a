// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/setup_picture.h"

#include <cstdint>
#include <vector>

#include <stb/stb_image_write.h>

#include "core/base64.h"
#include "emulated-ui/preview.h"

namespace standpoint {

namespace {

void append(void* context, void* bytes, int count) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  out.insert(out.end(), from, from + count);
}

}  // namespace

std::string setupPicture(const StoredSetup& setup) {
  auto preview = setup.preview;
  if (!preview) {
    Progress quiet;
    const auto read = readPreview(setup.file, quiet);
    if (!read) return {};
    preview = *read;
  }
  const auto columns = preview->columns, rows = preview->rows;
  std::vector<std::uint8_t> turned(preview->grey.size());  // a picture's first row is the uppermost
  for (std::uint32_t row = 0; row < rows; ++row)
    std::copy_n(preview->grey.begin() + std::size_t{rows - 1 - row} * columns, columns,
                turned.begin() + std::size_t{row} * columns);
  std::vector<std::uint8_t> png;
  if (stbi_write_png_to_func(append, &png, static_cast<int>(columns), static_cast<int>(rows), 1, turned.data(),
                             static_cast<int>(columns)) == 0)
    return {};
  return base64Of(png);
}

}  // namespace standpoint
