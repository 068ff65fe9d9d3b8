// SPDX-License-Identifier: BSD-3-Clause
#include "io/dxf_writer.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "base/text_fields.h"
#include "drawing/sheet.h"

namespace curvix {
namespace {

// Fixed handles of what entities and tables refer to.
constexpr char kBlockRecords[] = "1";
constexpr char kModelSpace[] = "1F";
constexpr char kPaperSpace[] = "1E";
constexpr char kPictures[] = "22";
constexpr char kDashed[] = "HIDDEN";
constexpr int kDefaultWidth = -3;

int ToInt(double value) { return static_cast<int>(std::lround(value)); }

std::string Hex(int handle) {
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "%X", handle);
  return text.data();
}

// Of $INSUNITS.
int UnitCode(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, int>, 5> kCodes = {
      {{"in", 1}, {"ft", 2}, {"mm", 4}, {"cm", 5}, {"m", 6}}};
  for (const auto& [name, code] : kCodes) {
    if (name == unit) return code;
  }
  return 0;
}

void BeginTable(const char* name, const char* handle, int count, DxfWriter& w) {
  w.Put(0, "TABLE");
  w.Put(2, name);
  w.Put(5, handle);
  w.Put(330, "0");
  w.Put(100, "AcDbSymbolTable");
  w.Put(70, count);
}

// The start of a record of the table that has `owner` as its handle.
void BeginRecord(const char* type,
                 const char* handle,
                 const char* owner,
                 const char* marker,
                 const char* name,
                 DxfWriter& w) {
  w.Put(0, type);
  if (*handle != '\0') {
    w.Put(5, handle);
  } else {
    w.PutHandle();
  }
  w.Put(330, owner);
  w.Put(100, "AcDbSymbolTableRecord");
  w.Put(100, marker);
  w.Put(2, name);
}

void PutLayers(const std::vector<DrawingLayer>& layers, DxfWriter& w) {
  BeginTable("LAYER", "2", static_cast<int>(layers.size()) + 1, w);
  std::vector<DrawingLayer> all = {{"0", 7, 0}};
  all.insert(all.end(), layers.begin(), layers.end());
  for (const DrawingLayer& layer : all) {
    BeginRecord("LAYER", "", "2", "AcDbLayerTableRecord", layer.name, w);
    w.Put(70, 0);
    w.Put(62, layer.color);
    w.Put(6, "Continuous");
    w.Put(370, layer.width > 0 ? ToInt(100 * layer.width) : kDefaultWidth);
    w.Put(390, "F");
  }
  w.Put(0, "ENDTAB");
}

void PutLineTypes(double dash, double gap, DxfWriter& w) {
  BeginTable("LTYPE", "5", 4, w);
  for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
    BeginRecord("LTYPE", "", "5", "AcDbLinetypeTableRecord", name, w);
    w.Put(70, 0);
    w.Put(3, "");
    w.Put(72, 65);
    w.Put(73, 0);
    w.Put(40, 0.0);
  }
  BeginRecord("LTYPE", "", "5", "AcDbLinetypeTableRecord", kDashed, w);
  w.Put(70, 0);
  w.Put(3, "_ _ _");
  w.Put(72, 65);
  w.Put(73, 2);
  w.Put(40, dash + gap);
  for (const double length : {dash, -gap}) {
    w.Put(49, length);
    w.Put(74, 0);
  }
  w.Put(0, "ENDTAB");
}

void PutViewport(const DxfView& view, DxfWriter& w) {
  BeginTable("VPORT", "8", 1, w);
  BeginRecord("VPORT", "", "8", "AcDbViewportTableRecord", "*Active", w);
  w.Put(70, 0);
  for (const auto& [code, x, y] : {std::tuple{10, 0.0, 0.0},
                                   {11, 1.0, 1.0},
                                   {12, view.center.x(), view.center.y()},
                                   {13, 0.0, 0.0},
                                   {14, 10.0, 10.0},
                                   {15, 10.0, 10.0}}) {
    w.Put(code, x);
    w.Put(code + 10, y);
  }
  w.Put(16, Eigen::Vector3d(0, 0, 1));
  w.Put(17, Eigen::Vector3d(0, 0, 0));
  w.Put(40, view.height);
  w.Put(41, 1.0);
  w.Put(42, 50.0);
  w.Put(0, "ENDTAB");
}

void PutStyles(DxfWriter& w) {
  BeginTable("STYLE", "3", 1, w);
  BeginRecord("STYLE", "11", "3", "AcDbTextStyleTableRecord", "Standard", w);
  w.Put(70, 0);
  w.Put(40, 0.0);
  w.Put(41, 1.0);
  w.Put(50, 0.0);
  w.Put(71, 0);
  w.Put(42, 2.5);
  w.Put(3, "txt");
  w.Put(4, "");
  w.Put(0, "ENDTAB");
}

// Sizes of dimensions: of text and ticks, gaps and ends of lines.
struct DimensionSize {
  const char* variable;
  int code;
  double mm;
};
constexpr std::array<DimensionSize, 5> kDimensionSizes = {
    {{"$DIMTXT", 140, kDimensionText},
     {"$DIMASZ", 41, 2},
     {"$DIMEXO", 42, 1.5},
     {"$DIMEXE", 44, 1.5},
     {"$DIMGAP", 147, 1}}};

void PutDimensionStyles(double mm, DxfWriter& w) {
  BeginTable("DIMSTYLE", "A", 1, w);
  w.Put(100, "AcDbDimStyleTable");
  w.Put(0, "DIMSTYLE");
  w.Put(105, "27");
  w.Put(330, "A");
  w.Put(100, "AcDbSymbolTableRecord");
  w.Put(100, "AcDbDimStyleTableRecord");
  w.Put(2, "Standard");
  w.Put(70, 0);
  for (const DimensionSize& size : kDimensionSizes) {
    w.Put(size.code, size.mm * mm);
  }
  w.Put(340, "11");
  w.Put(0, "ENDTAB");
}

void PutBlocks(const std::vector<DxfBlock>& blocks, DxfWriter& w) {
  w.BeginSection("BLOCKS");
  const auto begin = [&](const char* type, const std::string& record) {
    w.Put(0, type);
    w.PutHandle();
    w.Put(330, record);
    w.Put(100, "AcDbEntity");
    if (record == kPaperSpace) w.Put(67, 1);
    w.Put(8, "0");
  };
  for (const auto& [name, record, entities] : blocks) {
    begin("BLOCK", record);
    w.Put(100, "AcDbBlockBegin");
    w.Put(2, name);
    w.Put(70, name.starts_with("*D") ? 1 : 0);
    w.Put(10, Eigen::Vector3d(0, 0, 0));
    w.Put(3, name);
    w.Put(1, "");
    w.PutAll(entities);
    begin("ENDBLK", record);
    w.Put(100, "AcDbBlockEnd");
  }
  w.Put(0, "ENDSEC");
}

void BeginDictionary(const char* handle, const char* owner, DxfWriter& w) {
  w.Put(0, "DICTIONARY");
  w.Put(5, handle);
  w.Put(330, owner);
  w.Put(100, "AcDbDictionary");
  w.Put(281, 1);
}

void PutPicture(const DxfPicture& picture, DxfWriter& w) {
  BeginDictionary(kPictures, "C", w);
  w.Put(3, "photograph");
  w.Put(350, kDxfPictureHandle);
  w.Put(0, "IMAGEDEF");
  w.Put(5, kDxfPictureHandle);
  w.Put(102, "{ACAD_REACTORS");
  w.Put(330, kPictures);
  w.Put(330, kDxfReactorHandle);
  w.Put(102, "}");
  w.Put(330, kPictures);
  w.Put(100, "AcDbRasterImageDef");
  w.Put(90, 0);
  w.Put(1, picture.file);
  w.Put(10, picture.size);
  w.Put(11, Eigen::Vector2d(1, 1));
  w.Put(280, 1);
  w.Put(281, 0);
  w.Put(0, "IMAGEDEF_REACTOR");
  w.Put(5, kDxfReactorHandle);
  w.Put(330, picture.image_handle);
  w.Put(100, "AcDbRasterImageDefReactor");
  w.Put(90, 2);
  w.Put(330, picture.image_handle);
}

void PutClass(const char* record,
              const char* name,
              bool is_entity,
              DxfWriter& w) {
  w.Put(0, "CLASS");
  w.Put(1, record);
  w.Put(2, name);
  w.Put(3, "ObjectDBX Classes");
  w.Put(90, 0);
  w.Put(280, 0);
  w.Put(281, is_entity ? 1 : 0);
}

}  // namespace

void DxfWriter::Put(int code, std::string_view value) {
  out_ += std::to_string(code) + '\n';
  out_ += value;
  out_ += '\n';
}

void DxfWriter::Put(int code, double value) {
  std::string text = NumberText(value);
  // A number without point is not a real for every reader.
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  Put(code, text);
}

void DxfWriter::BeginSection(const char* name) {
  Put(0, "SECTION");
  Put(2, name);
}

std::string DxfWriter::PutHandle() {
  std::string handle = NewHandle();
  Put(5, handle);
  return handle;
}

std::string DxfWriter::NewHandle() { return Hex(next_handle_++); }

void DxfWriter::BeginEntity(const char* type, const char* layer, bool dashed) {
  Put(0, type);
  PutHandle();
  PutOwner(layer);
  if (dashed) Put(6, kDashed);
}

void DxfWriter::PutOwner(const char* layer) {
  Put(330, block_.empty() ? kModelSpace : block_);
  Put(100, "AcDbEntity");
  Put(8, layer);
}

std::string DxfWriter::Take() { return std::exchange(out_, {}); }

void PutDxfTables(const std::vector<DrawingLayer>& layers,
                  const DxfView& view,
                  double mm,
                  const std::vector<DxfBlock>& blocks,
                  DxfWriter& w) {
  std::vector<DxfBlock> all = {{"*Model_Space", kModelSpace, ""},
                               {"*Paper_Space", kPaperSpace, ""}};
  all.insert(all.end(), blocks.begin(), blocks.end());
  w.BeginSection("TABLES");
  PutViewport(view, w);
  PutLineTypes(kDash * mm, kDashGap * mm, w);
  PutLayers(layers, w);
  PutStyles(w);
  for (const auto& [name, handle] :
       {std::pair{"VIEW", "6"}, std::pair{"UCS", "7"}}) {
    BeginTable(name, handle, 0, w);
    w.Put(0, "ENDTAB");
  }
  BeginTable("APPID", "9", 1, w);
  BeginRecord("APPID", "12", "9", "AcDbRegAppTableRecord", "ACAD", w);
  w.Put(70, 0);
  w.Put(0, "ENDTAB");
  PutDimensionStyles(mm, w);
  BeginTable("BLOCK_RECORD", kBlockRecords, static_cast<int>(all.size()), w);
  for (const DxfBlock& block : all) {
    BeginRecord("BLOCK_RECORD",
                block.handle.c_str(),
                kBlockRecords,
                "AcDbBlockTableRecord",
                block.name.c_str(),
                w);
    w.Put(340, "0");
  }
  w.Put(0, "ENDTAB");
  w.Put(0, "ENDSEC");
  PutBlocks(all, w);
}

void PutDxfObjects(const DxfPicture* picture, DxfWriter& w) {
  w.BeginSection("OBJECTS");
  BeginDictionary("C", "0", w);
  w.Put(3, "ACAD_GROUP");
  w.Put(350, "D");
  if (picture != nullptr) {
    w.Put(3, "ACAD_IMAGE_DICT");
    w.Put(350, kPictures);
  }
  w.Put(3, "ACAD_PLOTSTYLENAME");
  w.Put(350, "E");
  BeginDictionary("D", "C", w);
  w.Put(0, "ACDBDICTIONARYWDFLT");
  w.Put(5, "E");
  w.Put(330, "C");
  w.Put(100, "AcDbDictionary");
  w.Put(281, 1);
  w.Put(3, "Normal");
  w.Put(350, "F");
  w.Put(100, "AcDbDictionaryWithDefault");
  w.Put(340, "F");
  w.Put(0, "ACDBPLACEHOLDER");
  w.Put(5, "F");
  w.Put(330, "E");
  if (picture != nullptr) PutPicture(*picture, w);
  w.Put(0, "ENDSEC");
  w.Put(0, "EOF");
}

std::string DxfHeader(int next_handle,
                      std::string_view unit,
                      double mm,
                      const DxfPaper* paper) {
  DxfWriter w;
  w.BeginSection("HEADER");
  w.Put(9, "$ACADVER");
  w.Put(1, "AC1015");
  w.Put(9, "$HANDSEED");
  w.Put(5, Hex(next_handle));
  w.Put(9, "$INSUNITS");
  w.Put(70, UnitCode(unit));
  for (const DimensionSize& size : kDimensionSizes) {
    w.Put(9, size.variable);
    w.Put(40, size.mm * mm);
  }
  if (paper != nullptr) {
    w.Put(9, "$PINSBASE");
    w.Put(10, Eigen::Vector3d(paper->origin.x(), paper->origin.y(), 0));
    w.Put(9, "$PLIMMIN");
    w.Put(10, Eigen::Vector2d(0, 0));
    w.Put(9, "$PLIMMAX");
    w.Put(10, paper->size);
    w.Put(9, "$PSVPSCALE");
    w.Put(40, paper->scale);
  }
  w.Put(0, "ENDSEC");
  w.BeginSection("CLASSES");
  PutClass("ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault", false, w);
  PutClass("IMAGE", "AcDbRasterImage", true, w);
  PutClass("IMAGEDEF", "AcDbRasterImageDef", false, w);
  PutClass("IMAGEDEF_REACTOR", "AcDbRasterImageDefReactor", false, w);
  w.Put(0, "ENDSEC");
  return w.Take();
}

}  // namespace curvix
