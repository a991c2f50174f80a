#pragma once
// Fabrics: records of Kawabata or SI figures to design::Fabric and back.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {

/// A field by its name ("bend_warp", "G", "EM_warp"), SI; nothing if there is no such field.
std::optional<Value> fabric_field(const design::Fabric& fabric, const std::string& name);
std::vector<std::string> fabric_field_names();

/// A fabric made of `base` (null: the stated defaults) and the fields of a record expression.
std::shared_ptr<const design::Fabric> fabric_from_record(Program& program, const design::Fabric* base,
                                                         const Expr& record, Scope& scope);

/// `fabric NAME = ...` with its assignments.
Value evaluate_fabric(Program& program, Declaration& declaration);

/// Index in Garment::fabrics; the fabric is taken in at its first use.
int fabric_index(Program& program, const std::shared_ptr<const design::Fabric>& fabric);

}  // namespace garment::interpreter
