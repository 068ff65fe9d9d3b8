// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What every DXF file of AutoCAD 2000 has around its
// entities.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/drawing_layers.h"

namespace curvix {

// Pairs of a group code and a value, each on its own line.
class DxfWriter {
 public:
  void Put(int code, std::string_view value);
  void Put(int code, double value);
  void Put(int code, int value) { Put(code, std::to_string(value)); }
  void Put(int code, const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) Put(code + 10 * i, v[i]);
  }
  void Put(int code, const Eigen::Vector2d& v) {
    for (int i = 0; i < 2; ++i) Put(code + 10 * i, v[i]);
  }
  void BeginSection(const char* name);
  // The start of an entity in model space, of the type of lines of its layer,
  // or dashed.
  void BeginEntity(const char* type, const char* layer, bool dashed = false);
  // The same in steps: type, handle (a new one), owner and layer.
  std::string PutHandle();
  void PutOwner(const char* layer);
  // A handle that is not put, and the block of the entities from here on; "":
  // model space.
  std::string NewHandle();
  void SetBlock(std::string handle) { block_ = std::move(handle); }
  void PutAll(const std::string& entities) { out_ += entities; }
  // What was put since the last time.
  std::string Take();
  int next_handle() const { return next_handle_; }

 private:
  std::string out_;
  std::string block_;
  int next_handle_ = 0x100;  // below are those that are fixed
};

// A picture in a file, as IMAGE entities refer to it.
struct DxfPicture {
  std::string file;
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  // pixels
  std::string image_handle;                        // of the IMAGE
};
constexpr char kDxfPictureHandle[] = "20";
constexpr char kDxfReactorHandle[] = "21";

// A block beside those of model and paper space.
struct DxfBlock {
  std::string name;  // "*D1"
  std::string handle;
  std::string entities;
};

// What a program shows first.
struct DxfView {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double height = 10;
};

// The paper on which model space is printed: drawing units, as LibreCAD takes
// them.
struct DxfPaper {
  Eigen::Vector2d size;
  Eigen::Vector2d origin;  // of model space, on the paper
  double scale = 1;        // 0.02 for 1:50
};

// The sections before the entities. `next_handle`: the first that the entities
// do not use. `unit` is "mm", "cm", "m", "in", "ft" or none of these. `paper`
// may be null. `mm`: drawing units on a millimetre of paper, here and below.
std::string DxfHeader(int next_handle,
                      std::string_view unit,
                      double mm,
                      const DxfPaper* paper);
void PutDxfTables(const std::vector<DrawingLayer>& layers,
                  const DxfView& view,
                  double mm,
                  const std::vector<DxfBlock>& blocks,
                  DxfWriter& w);
// The section behind them, and the end. `picture` may be null.
void PutDxfObjects(const DxfPicture* picture, DxfWriter& w);

}  // namespace curvix
