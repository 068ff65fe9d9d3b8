// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Chooses the format by the extension.
#include <curvix/curve_io.h>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "base/count_text.h"
#include "base/file_io.h"
#include "io/curve_formats.h"
#include "io/pcl_lines.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// kInvalidArgument: another extension than ".ply" and so on.
Status Encode(const std::string& extension,
              const CurveSource& curves,
              const Scene& scene,
              std::string_view frame,
              const ByteSink& sink) {
  if (extension == ".ply") return EncodePlyLines(curves, frame, sink);
  if (extension == ".pcd") return EncodePcd(curves, sink);
  if (extension == ".glb") return EncodeGlbCurves(curves, sink);
  if (extension == ".obj") {
    EncodeObjLines(curves, sink);
  } else if (extension == ".txt") {
    EncodeTxtCurves(curves, scene, sink);
  } else if (extension == ".vtp") {
    EncodeVtpCurves(curves, sink);
  } else {
    return Status::InvalidArgument(
        "curves are written as .ply, .pcd, .obj, .txt, .vtp or .glb, not as "
        "\"" +
        extension + "\"");
  }
  return {};
}

Result<CurveSet> Decode(const std::string& extension,
                        const std::string& bytes,
                        const Scene& scene) {
  if (extension == ".ply") return DecodePlyLines(bytes);
  if (extension == ".obj") return DecodeObjLines(bytes);
  if (extension == ".txt") return DecodeTxtCurves(bytes, scene);
  return Status::InvalidArgument(
      "curves are read from .ply, .obj or .txt, not from \"" + extension +
      "\"");
}

// What of a sample no format can hold; "": nothing.
std::string WrongIn(const CurveSample& sample) {
  // Files of 32 bits have no others.
  const auto is_in_range = [](double x) {
    return std::abs(x) <= std::numeric_limits<float>::max();
  };
  const Eigen::Vector3d& p = sample.position;
  if (!is_in_range(p.x()) || !is_in_range(p.y()) || !is_in_range(p.z())) {
    return "a position that is not finite or too large for files";
  }
  if (!sample.tangent.allFinite()) return "a tangent that is not finite";
  if (!std::isfinite(sample.sigma)) return "a sigma that is not finite";
  return "";
}

Status CheckCurve(std::size_t id, const Curve& curve) {
  const std::string name = "curve " + std::to_string(id);
  if (curve.samples.size() < 2) {
    return Status::InvalidArgument(
        name + " has " + Plural(curve.samples.size(), "sample") +
        ", and lines need two or more; leave it out");
  }
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const std::string wrong = WrongIn(curve.samples[i]);
    if (wrong.empty()) continue;
    return Status::InvalidArgument("sample " + std::to_string(i) + " of " +
                                   name + " has " + wrong +
                                   "; correct it or leave it out");
  }
  return {};
}

// The curves up to the first that no file can hold; status() says why.
class CheckedCurves : public CurveSource {
 public:
  explicit CheckedCurves(const CurveSource& curves) : curves_(curves) {}

  std::size_t size() const override { return curves_.size(); }
  void ForEach(const Visit& visit) const override {
    wrong_ = {};  // a writer may go through the curves more than once
    curves_.ForEach([&](std::size_t id, const Curve& curve) {
      if (wrong_.ok()) wrong_ = CheckCurve(id, curve);
      if (wrong_.ok()) visit(id, curve);
    });
  }
  Status status() const override {
    return curves_.status().ok() ? wrong_ : curves_.status();
  }
  Edge2d EdgeOf(const EdgeRef& ref) const override {
    return curves_.EdgeOf(ref);
  }

 private:
  const CurveSource& curves_;
  mutable Status wrong_;
};

// A file of what `encode` gives for its extension. If `curves` is given, its
// status comes before that of `encode`.
using Encoder =
    std::function<Status(const std::string& extension, const ByteSink& sink)>;
Status Write(const fs::path& path,
             const Encoder& encode,
             const CurveSource* curves = nullptr) {
  FileWriter file(path);
  const Status status = encode(ExtensionOf(path), file.Sink());
  if (curves != nullptr && !curves->status().ok()) return curves->status();
  return status.ok() ? file.Finish() : InFile(path, status);
}

}  // namespace

Status WriteCurves(const fs::path& path,
                   const CurveSource& curves,
                   const Scene& scene,
                   std::string_view frame) {
  const CheckedCurves checked(curves);
  return Write(
      path,
      [&](const std::string& extension, const ByteSink& sink) {
        return Encode(extension, checked, scene, frame, sink);
      },
      &checked);
}

Result<CurveSet> ReadCurves(const fs::path& path, const Scene& scene) {
  CURVIX_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  Result<CurveSet> curves = Decode(ExtensionOf(path), bytes, scene);
  if (!curves.ok()) return InFile(path, curves.status());
  return curves;
}

Status WriteEdges(const fs::path& path, const std::vector<Edge3d>& edges) {
  return Write(path, [&](const std::string& extension, const ByteSink& sink) {
    return extension == ".ply"
               ? EncodePlyEdges(edges, sink)
               : Status::InvalidArgument("edges are written as .ply");
  });
}

Status WriteDrawing(const fs::path& path,
                    const FittedCurves& fitted,
                    std::string_view unit) {
  return Write(path, [&](const std::string& extension, const ByteSink& sink) {
    if (extension == ".dxf") {
      EncodeDxfDrawing(fitted, unit, sink);
    } else if (extension == ".step") {
      EncodeStepDrawing(fitted, sink);
    } else {
      return Status::InvalidArgument(
          "fitted curves are written as .dxf or .step, not as \"" + extension +
          "\"");
    }
    return Status();
  });
}

Status WriteProjection(const fs::path& path,
                       const CurveSource& curves,
                       const Scene& scene,
                       int view_idx) {
  const CheckedCurves checked(curves);
  return Write(
      path,
      [&](const std::string& extension, const ByteSink& sink) {
        if (extension != ".svg") {
          return Status::InvalidArgument(
              "projected curves are written as .svg, not as \"" + extension +
              "\"");
        }
        if (view_idx < 0 || view_idx >= std::ssize(scene.views)) {
          return Status::InvalidArgument("there is no view " +
                                         std::to_string(view_idx));
        }
        EncodeSvgCurves(checked, scene, view_idx, sink);
        return Status();
      },
      &checked);
}

}  // namespace curvix
