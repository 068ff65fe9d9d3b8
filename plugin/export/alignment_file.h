// SPDX-License-Identifier: BSD-3-Clause
// alignment.json: scale and axes that `colmap_curvix align` has found.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <optional>

#include "measuring/world_alignment.h"
#include "plugin/export/curves_json.h"

namespace curvix {

constexpr const char* kAlignmentName = "alignment.json";

// The members of alignment.json, as docs/measuring.md describes them, but for
// `sources`, which say what it was found from.
Json AlignmentJson(const WorldAlignment& alignment);

// The same, back. kDataLoss, with the member that is missing or wrong.
Result<WorldAlignment> AlignmentFromJson(const Json& json);

// The member `cameras`: by image, the centre of its camera in the model.
Json CentersJson(const Scene& scene);

// alignment.json in a folder of results. nullopt: there is none. kDataLoss,
// with its path and what to do: it is broken, or the cameras of `model`, if it
// is given, are elsewhere than `cameras` says.
Result<std::optional<WorldAlignment>> ReadAlignment(
    const std::filesystem::path& folder, const Scene* model = nullptr);

}  // namespace curvix
