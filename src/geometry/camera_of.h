// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The camera of a view.
#pragma once

#include <curvix/scene.h>
#include <cstddef>

namespace curvix {

// `view` is one of the scene's, or has the index of one of its cameras.
inline const Camera& CameraOf(const Scene& scene, const View& view) {
  return scene.cameras[static_cast<std::size_t>(view.camera_idx)];
}

}  // namespace curvix
