#include "interpreter/language/collections.hpp"

#include <algorithm>

#include "runtime/base/limits.hpp"

namespace garment::interpreter {
namespace {

constexpr std::size_t kOverhead = 64;  // of a shared block and its counts, bytes

int depth_of(const Value& value) {
  if (const auto* list = value.as<ListValue>()) return (*list)->depth;
  if (const auto* record = value.as<RecordValue>()) return (*record)->depth;
  return 0;
}

/// One more than the deepest of what is inside; refuses what is nested too deep.
int nested(Program& program, int inside, Span span) {
  if (inside + 1 <= kMaxValueDepth) return inside + 1;
  fail(program, Message("G1602",
                        "lists and records nest " + std::to_string(inside + 1) + " deep here; at most " +
                            std::to_string(kMaxValueDepth) + " are allowed",
                        span)
                    .help("put the values side by side in one list: `a + b` joins lists"));
}

}  // namespace

Charge charge_memory(Program& program, std::size_t bytes, Span span) {
  if (bytes <= kMaxValueBytes && program.meter->held <= kMaxValueBytes - bytes)
    return Charge(program.meter, bytes);
  report(program, Message("G1601", "the values of the script would take more than 1 GiB of memory", span)
                      .help("lists and texts grow here: make them shorter, or keep fewer of them"));
  throw Exhausted{};
}

Value text_value(Program& program, std::string text, Span span) {
  if (text.size() > kMaxText)
    fail(program, Message("G0326", "the text grows past 1 MB", span)
                      .help("make it shorter; texts are for names, labels and messages"));
  Charge charge = charge_memory(program, kOverhead + text.capacity(), span);
  return Value{TextValue(std::make_shared<TextBody>(TextBody{std::move(text), std::move(charge)}))};
}

Value own_text(std::string text) { return Value{TextValue(std::make_shared<TextBody>(TextBody{std::move(text), {}}))}; }

ListBuilder::ListBuilder(Program& program, std::size_t size, Span span) : program_(program), span_(span) {
  Charge charge =
      charge_memory(program, size > kMaxValueBytes / sizeof(Value) ? kMaxValueBytes + 1 : kOverhead + size * sizeof(Value),
                    span);
  list_ = std::make_shared<ListBody>();
  list_->charge = std::move(charge);
  list_->reserve(size);
}

void ListBuilder::add(Value value) { list_->push_back(std::move(value)); }

Value ListBuilder::finish() {
  int inside = 0;
  for (const Value& value : *list_) inside = std::max(inside, depth_of(value));
  list_->depth = nested(program_, inside, span_);
  return Value{ListValue(std::move(list_))};
}

Value list_value(Program& program, const std::vector<Value>& values, Span span) {
  ListBuilder list(program, values.size(), span);
  for (const Value& value : values) list.add(value);
  return list.finish();
}

bool equal_values(Program& program, const Value& a, const Value& b, Span span) {
  count_step(program, span);
  if (const auto *p = a.as<ListValue>(), *q = b.as<ListValue>(); p != nullptr && q != nullptr) {
    if ((*p)->size() != (*q)->size()) return false;
    for (std::size_t k = 0; k < (*p)->size(); ++k)
      if (!equal_values(program, (**p)[k], (**q)[k], span)) return false;
    return true;
  }
  if (const auto *p = a.as<RecordValue>(), *q = b.as<RecordValue>(); p != nullptr && q != nullptr) {
    if ((*p)->size() != (*q)->size()) return false;
    for (const auto& [name, value] : **p) {
      const auto found = std::find_if((*q)->begin(), (*q)->end(), [&](const auto& field) { return field.first == name; });
      if (found == (*q)->end() || !equal_values(program, value, found->second, span)) return false;
    }
    return true;
  }
  return same_value(a, b);
}

Value record_value(Program& program, RecordFields fields, Span span) {
  std::size_t bytes = kOverhead + fields.capacity() * sizeof(fields[0]);
  int inside = 0;
  for (const auto& [name, value] : fields) {
    bytes += name.capacity();
    inside = std::max(inside, depth_of(value));
  }
  auto record = std::make_shared<RecordBody>();
  record->charge = charge_memory(program, bytes, span);
  record->depth = nested(program, inside, span);
  static_cast<RecordFields&>(*record) = std::move(fields);
  return Value{RecordValue(std::move(record))};
}

}  // namespace garment::interpreter
