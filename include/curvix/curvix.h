// SPDX-License-Identifier: BSD-3-Clause
// Everything public.
#pragma once

#include <curvix/colmap_io.h>
#include <curvix/curve_io.h>
#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <curvix/status.h>
