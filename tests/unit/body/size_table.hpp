#pragma once
// The size table of the reference data as mannequins.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"

namespace garment::body {

struct SizeRow {
  design::Mannequin person;
  double weight = 0;  // kg
};

/// The size table; empty (said aloud) where the reference data is absent.
inline std::vector<SizeRow> size_table() {
  std::ifstream file(std::string(GARMENT_DATA_DIR) + "/tables/mannequin_sizes.csv");
  std::vector<SizeRow> rows;
  std::vector<std::string> header;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    SizeRow row;
    row.person.sex = cells[0] == "F" ? design::Mannequin::Sex::woman : design::Mannequin::Sex::man;
    row.person.size = std::stod(cells[1]);
    for (std::size_t i = 2; i < cells.size(); ++i) {
      if (cells[i].empty()) continue;
      if (header[i] == "weightkg")
        row.weight = std::stod(cells[i]);
      else
        row.person.measures[header[i]] = std::stod(cells[i]) / 100;
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) WARN("skipped: no size table in " GARMENT_DATA_DIR);
  return rows;
}

inline design::Body declare(const design::Mannequin& person) {
  design::Body body;
  body.name = "form";
  body.shape = person;
  return body;
}

}  // namespace garment::body
