// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/card.hpp"

#include <utility>

namespace engrane::deck {

namespace {

std::vector<std::string> strings(Words words) { return {words.begin(), words.end()}; }

/// Stores the values of a deck in a member.
struct Store {
  const Field::Values& values;

  void operator()(std::monostate) const {}
  void operator()(bool* member) const { *member = true; }
  void operator()(int* member) const { *member = static_cast<int>(values.numbers.front()); }
  void operator()(double* member) const { *member = values.numbers.front(); }
  void operator()(std::string* member) const { *member = values.texts.front(); }
  void operator()(Tagged* member) const { *member = {values.tag, values.numbers}; }
  void operator()(std::vector<std::string>* member) const { *member = values.texts; }
  template <class Value>
  void operator()(std::span<Value> member) const {
    for (std::size_t i = 0; i < member.size() && i < values.numbers.size(); ++i)
      member[i] = static_cast<Value>(values.numbers[i]);
  }
  template <std::size_t N>
  void operator()(std::array<double, N>* member) const {
    (*this)(std::span<double>(*member));
  }
  template <class Value>
  void operator()(std::vector<Value>* member) const {
    member->resize(values.numbers.size());
    (*this)(std::span<Value>(*member));
  }
  template <class Value>
  void operator()(std::optional<Value>* member) const {
    (*this)(&member->emplace());
  }
};

/// Loads a member as the values with which a deck would set it.
struct Load {
  Field::Values& values;

  void operator()(std::monostate) const {}
  void operator()(const bool* member) const { values.present = *member; }
  void operator()(const int* member) const { one(*member); }
  void operator()(const double* member) const { one(*member); }
  void operator()(const std::string* member) const {
    values.texts = {*member};
    values.present = !member->empty();
  }
  void operator()(const Tagged* member) const {
    values.tag = member->tag;
    values.numbers = member->values;
    values.present = member->given();
  }
  void operator()(const std::vector<std::string>* member) const {
    values.texts = *member;
    values.present = !member->empty();
  }
  template <class Value>
  void operator()(std::span<Value> member) const {
    values.numbers.assign(member.begin(), member.end());
    values.present = !member.empty();
  }
  template <std::size_t N>
  void operator()(const std::array<double, N>* member) const {
    (*this)(std::span<const double>(*member));
  }
  template <class Value>
  void operator()(const std::vector<Value>* member) const {
    (*this)(std::span<const Value>(*member));
  }
  template <class Value>
  void operator()(const std::optional<Value>* member) const {
    if (*member) (*this)(&**member);
  }
  void one(double value) const {
    values.numbers = {value};
    values.present = true;
  }
};

}  // namespace

void Field::store(std::any& data, const Values& values) const {
  if (bind) std::visit(Store{values}, bind(data));
}

Field::Values Field::load(const std::any& data) const {
  Values values;
  // Load only reads the member, hence the const_cast. An array is loaded as a whole, not by its parts.
  if (bind && whole.empty()) std::visit(Load{values}, bind(const_cast<std::any&>(data)));
  return values;
}

FieldBuilder& FieldBuilder::synonyms(Words words) {
  field().synonyms = strings(words);
  field().spellings = collect_spellings(field());
  return *this;
}
FieldBuilder& FieldBuilder::unit(Dimension d) {
  field().dimension = d;
  return *this;
}
FieldBuilder& FieldBuilder::refers(Reference r) {
  field().reference = r;
  return *this;
}
FieldBuilder& FieldBuilder::required() {
  field().required = true;
  return *this;
}
FieldBuilder& FieldBuilder::positional() {
  field().positional = true;
  return *this;
}
FieldBuilder& FieldBuilder::values(int least, int most) {
  field().min_values = least;
  field().max_values = most;
  return *this;
}
FieldBuilder& FieldBuilder::positive() {
  field().lower = 0;
  field().lower_open = true;
  return *this;
}
FieldBuilder& FieldBuilder::at_least(double bound) {
  field().lower = bound;
  return *this;
}
FieldBuilder& FieldBuilder::at_most(double bound) {
  field().upper = bound;
  return *this;
}
FieldBuilder& FieldBuilder::below(double bound) {
  field().upper = bound;
  field().upper_open = true;
  return *this;
}
FieldBuilder& FieldBuilder::above(double bound) {
  field().lower = bound;
  field().lower_open = true;
  return *this;
}
FieldBuilder& FieldBuilder::leads() {
  field().leads = true;
  return *this;
}
FieldBuilder& FieldBuilder::repeats() {
  field().repeats = true;
  return *this;
}
FieldBuilder& FieldBuilder::heading() {
  field().heading = true;
  return *this;
}
FieldBuilder& FieldBuilder::filler(Words words) {
  field().fillers = strings(words);
  return *this;
}
FieldBuilder& FieldBuilder::codes(std::vector<Code> known) {
  field().codes = std::move(known);
  return *this;
}
FieldBuilder& FieldBuilder::option(Option o) {
  field().options.push_back(std::move(o));
  return *this;
}

CardText::CardText(std::string_view name, Words synonyms, std::string_view summary, std::function<std::any()> make) {
  schema_.name = name;
  schema_.synonyms = strings(synonyms);
  schema_.summary = summary;
  schema_.make = std::move(make);
}

CardText& CardText::chapter(std::string_view title) {
  schema_.chapter = title;
  return *this;
}
CardText& CardText::describe(std::string_view text) {
  schema_.description = text;
  return *this;
}
CardText& CardText::example(std::string_view lines) {
  schema_.examples.emplace_back(lines);
  return *this;
}
CardText& CardText::numbered() {
  schema_.numbered = true;
  return *this;
}
CardText& CardText::key(std::string_view word) {
  schema_.numbered = true;
  schema_.record_key = word;
  return *this;
}
CardText& CardText::unite(void (*records_of_deck)(const std::vector<Record*>&, Diagnostics&)) {
  schema_.unite = records_of_deck;
  return *this;
}

CardText& CardText::repeated_ids() {
  schema_.repeated_ids = true;
  return *this;
}
CardText& CardText::rows() {
  schema_.rows = true;
  return *this;
}
CardText& CardText::once() {
  schema_.once = true;
  return *this;
}
CardText& CardText::redefines() {
  schema_.redefines = true;
  return *this;
}

Field& CardText::add_field(std::string_view keyword, std::string_view help, Shape shape, std::function<Member(std::any&)> bind) {
  Field& field = schema_.fields.emplace_back();
  field.keyword = keyword;
  field.spellings = collect_spellings(field);
  field.help = help;
  field.type = shape.type;
  field.min_values = shape.least;
  field.max_values = shape.most;
  field.bind = std::move(bind);
  return field;
}

FieldBuilder CardText::last_field() { return FieldBuilder(schema_, schema_.fields.size() - 1); }

FieldBuilder CardText::add_mesh_file(std::string_view keyword, std::string_view help) {
  Field& field = add_field(keyword, help, {FieldType::text, 1, 1}, nullptr);  // canonical decks hold its records instead
  field.heading = field.mesh_file = true;
  return last_field();
}

}  // namespace engrane::deck
