// SPDX-License-Identifier: BSD-3-Clause
// Whole files: read at once, and written so that a reader never meets half of
// one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <curvix/status.h>

namespace curvix {

// Writes `bytes` to `path` with ".tmp" appended, in the same folder, and
// renames that to `path`, so that `path` holds either its old content or all of
// the new one, also when the disk is full or the program is killed. A failure
// removes the temporary file and leaves `path` as it was. The folder must
// exist. kInvalidArgument, with the system's reason, if it cannot be written.
Status WriteFileAtomically(const std::filesystem::path& path,
                           std::string_view bytes);

// All bytes of `path`. kNotFound if it is not a file that can be opened,
// kDataLoss if it cannot be read to its end.
Result<std::string> ReadFile(const std::filesystem::path& path);

}  // namespace curvix
