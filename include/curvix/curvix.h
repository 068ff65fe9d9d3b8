// SPDX-License-Identifier: BSD-3-Clause
// Everything public.
#pragma once

#include <curvix/camera_model.h>
#include <curvix/curve_io.h>
#include <curvix/curve_source.h>
#include <curvix/curve_style.h>
#include <curvix/curves.h>
#include <curvix/edge_sketch.h>
#include <curvix/edges.h>
#include <curvix/file_io.h>
#include <curvix/fitting.h>
#include <curvix/holdout.h>
#include <curvix/image_size.h>
#include <curvix/option_table.h>
#include <curvix/options.h>
#include <curvix/parallel.h>
#include <curvix/parts.h>
#include <curvix/project_curve.h>
#include <curvix/reconstruct.h>
#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <curvix/stage_io.h>
#include <curvix/status.h>
#include <curvix/stopwatch.h>
#include <curvix/synthetic.h>
#include <curvix/text_fields.h>
