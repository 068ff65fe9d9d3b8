// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for VTK and ParaView.
#include "io/curve_formats.h"

#include <cstddef>
#include <string>

#include "base/text_fields.h"
#include "io/curve_style.h"

namespace curvix {
namespace {

template <typename T>
void AppendItem(T value, std::string& out) {
  AppendNumber(value, out);
  out += '\n';
}

void AppendVector(const Eigen::Vector3d& v, std::string& out) {
  AppendNumbers(v, ' ', out);
  out += '\n';
}

// Puts one array after the other; `append` writes the numbers of one curve.
class ArrayWriter {
 public:
  ArrayWriter(const CurveSource& curves, const ByteSink& sink)
      : curves_(curves), sink_(sink) {}

  template <typename Append>
  void PerCurve(const std::string& attributes, Append append) const {
    sink_("        <DataArray " + attributes + " format=\"ascii\">\n");
    curves_.ForEach([&](std::size_t id, const Curve& curve) {
      std::string out;
      append(id, curve, out);
      sink_(out);
    });
    sink_("        </DataArray>\n");
  }
  template <typename Append>
  void PerSample(const std::string& attributes, Append append) const {
    PerCurve(attributes,
             [&](std::size_t, const Curve& curve, std::string& out) {
               for (const CurveSample& sample : curve.samples) {
                 append(sample, out);
               }
             });
  }

 private:
  const CurveSource& curves_;
  const ByteSink& sink_;
};

void PutPointData(const ArrayWriter& arrays, const ByteSink& sink) {
  sink("      <PointData Vectors=\"tangent\" Scalars=\"support\">\n");
  arrays.PerSample("type=\"Float64\" Name=\"tangent\" NumberOfComponents=\"3\"",
                   [](const CurveSample& s, std::string& out) {
                     AppendVector(s.tangent, out);
                   });
  arrays.PerSample(
      "type=\"Float64\" Name=\"sigma\"",
      [](const CurveSample& s, std::string& out) { AppendItem(s.sigma, out); });
  arrays.PerSample("type=\"Int64\" Name=\"support\"",
                   [](const CurveSample& s, std::string& out) {
                     AppendItem(s.support.size(), out);
                   });
  arrays.PerSample("type=\"Float32\" Name=\"confidence\"",
                   [](const CurveSample& s, std::string& out) {
                     AppendItem(Confidence(s.support.size()), out);
                   });
  sink("      </PointData>\n");
}

void PutCellData(const ArrayWriter& arrays, const ByteSink& sink) {
  sink("      <CellData Scalars=\"curve_id\">\n");
  arrays.PerCurve("type=\"Int64\" Name=\"curve_id\"",
                  [](std::size_t id, const Curve&, std::string& out) {
                    AppendItem(id, out);
                  });
  arrays.PerCurve("type=\"Float64\" Name=\"length\"",
                  [](std::size_t, const Curve& curve, std::string& out) {
                    AppendItem(Length(curve), out);
                  });
  sink("      </CellData>\n");
}

void PutLines(const ArrayWriter& arrays, const ByteSink& sink) {
  sink("      <Lines>\n");
  std::size_t first = 0;
  arrays.PerCurve("type=\"Int64\" Name=\"connectivity\"",
                  [&](std::size_t, const Curve& curve, std::string& out) {
                    for (std::size_t i = 0; i < curve.samples.size(); ++i) {
                      AppendItem(first + i, out);
                    }
                    if (curve.closed) AppendItem(first, out);
                    first += curve.samples.size();
                  });
  std::size_t end = 0;
  arrays.PerCurve("type=\"Int64\" Name=\"offsets\"",
                  [&](std::size_t, const Curve& curve, std::string& out) {
                    end += curve.samples.size() + (curve.closed ? 1 : 0);
                    AppendItem(end, out);
                  });
  sink("      </Lines>\n");
}

}  // namespace

void EncodeVtpCurves(const CurveSource& curves, const ByteSink& sink) {
  sink(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PolyData>\n"
      "    <Piece NumberOfPoints=\"" +
      std::to_string(CountSamples(curves)) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
      std::to_string(curves.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n");
  const ArrayWriter arrays(curves, sink);
  PutPointData(arrays, sink);
  PutCellData(arrays, sink);
  sink("      <Points>\n");
  arrays.PerSample("type=\"Float64\" NumberOfComponents=\"3\"",
                   [](const CurveSample& s, std::string& out) {
                     AppendVector(s.position, out);
                   });
  sink("      </Points>\n");
  PutLines(arrays, sink);
  sink("    </Piece>\n  </PolyData>\n</VTKFile>\n");
}

}  // namespace curvix
