// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for VTK and ParaView.
#include "output/vtp_curves.h"

#include <curvix/text_fields.h>

#include <cstddef>
#include <string_view>

#include <curvix/curve_style.h>

namespace curvix {
namespace {

// One <DataArray> whose numbers `append` writes.
template <typename Append>
void AppendArray(std::string_view attributes, Append append, std::string& out) {
  out += "        <DataArray ";
  out += attributes;
  out += " format=\"ascii\">\n";
  append();
  out += "        </DataArray>\n";
}

template <typename T>
void AppendItem(T value, std::string& out) {
  AppendNumber(value, out);
  out += '\n';
}

void AppendVector(const Eigen::Vector3d& v, std::string& out) {
  for (int i = 0; i < 3; ++i) {
    AppendNumber(v[i], out);
    out += i < 2 ? ' ' : '\n';
  }
}

// Calls `use` with every sample in order.
template <typename Use>
void ForEachSample(const CurveSet& curves, Use use) {
  for (const Curve& curve : curves.curves) {
    for (const CurveSample& sample : curve.samples) use(sample);
  }
}

void AppendPointData(const CurveSet& curves, std::string& out) {
  const auto array = [&](std::string_view attributes, auto value) {
    AppendArray(
        attributes,
        [&] {
          ForEachSample(curves,
                        [&](const auto& s) { AppendItem(value(s), out); });
        },
        out);
  };
  out += "      <PointData Vectors=\"tangent\" Scalars=\"support\">\n";
  AppendArray(
      "type=\"Float64\" Name=\"tangent\" NumberOfComponents=\"3\"",
      [&] {
        ForEachSample(curves,
                      [&](const auto& s) { AppendVector(s.tangent, out); });
      },
      out);
  array("type=\"Float64\" Name=\"sigma\"",
        [](const CurveSample& s) { return s.sigma; });
  array("type=\"Int64\" Name=\"support\"",
        [](const CurveSample& s) { return s.support.size(); });
  array("type=\"Float32\" Name=\"confidence\"",
        [](const CurveSample& s) { return Confidence(s.support.size()); });
  out += "      </PointData>\n";
}

void AppendCellData(const CurveSet& curves, std::string& out) {
  out += "      <CellData Scalars=\"curve_id\">\n";
  AppendArray(
      "type=\"Int64\" Name=\"curve_id\"",
      [&] {
        for (std::size_t id = 0; id < curves.curves.size(); ++id) {
          AppendItem(id, out);
        }
      },
      out);
  AppendArray(
      "type=\"Float64\" Name=\"length\"",
      [&] {
        for (const Curve& curve : curves.curves) AppendItem(Length(curve), out);
      },
      out);
  out += "      </CellData>\n";
}

void AppendLines(const CurveSet& curves, std::string& out) {
  out += "      <Lines>\n";
  AppendArray(
      "type=\"Int64\" Name=\"connectivity\"",
      [&] {
        std::size_t first = 0;
        for (const Curve& curve : curves.curves) {
          for (std::size_t i = 0; i < curve.samples.size(); ++i) {
            AppendItem(first + i, out);
          }
          if (curve.closed) AppendItem(first, out);
          first += curve.samples.size();
        }
      },
      out);
  AppendArray(
      "type=\"Int64\" Name=\"offsets\"",
      [&] {
        std::size_t end = 0;
        for (const Curve& curve : curves.curves) {
          end += curve.samples.size() + (curve.closed ? 1 : 0);
          AppendItem(end, out);
        }
      },
      out);
  out += "      </Lines>\n";
}

}  // namespace

std::string EncodeVtpCurves(const CurveSet& curves) {
  std::size_t num_points = 0;
  for (const Curve& curve : curves.curves) num_points += curve.samples.size();
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PolyData>\n"
      "    <Piece NumberOfPoints=\"";
  AppendNumber(num_points, out);
  out += "\" NumberOfVerts=\"0\" NumberOfLines=\"";
  AppendNumber(curves.curves.size(), out);
  out += "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  AppendPointData(curves, out);
  AppendCellData(curves, out);
  out += "      <Points>\n";
  AppendArray(
      "type=\"Float64\" NumberOfComponents=\"3\"",
      [&] {
        ForEachSample(curves,
                      [&](const auto& s) { AppendVector(s.position, out); });
      },
      out);
  out += "      </Points>\n";
  AppendLines(curves, out);
  out += "    </Piece>\n  </PolyData>\n</VTKFile>\n";
  return out;
}

}  // namespace curvix
