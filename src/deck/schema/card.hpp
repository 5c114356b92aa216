// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <array>
#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// Words of a declaration: literals, copied into the schema.
using Words = std::initializer_list<std::string_view>;

/// Refines the field just added to a Card.
class FieldBuilder {
 public:
  FieldBuilder(Schema& schema, std::size_t index) : schema_(schema), index_(index) {}
  FieldBuilder& synonyms(Words words);
  FieldBuilder& unit(Dimension d);
  FieldBuilder& refers(Reference r);
  FieldBuilder& required();
  FieldBuilder& positional();
  FieldBuilder& values(int least, int most);
  FieldBuilder& positive();
  FieldBuilder& at_least(double bound);
  FieldBuilder& at_most(double bound);
  FieldBuilder& below(double bound);
  FieldBuilder& above(double bound);
  FieldBuilder& leads();
  FieldBuilder& repeats();
  FieldBuilder& heading();
  FieldBuilder& filler(Words words);
  FieldBuilder& codes(std::vector<Code> known);
  FieldBuilder& option(Option o);

 private:
  Field& field() { return schema_.fields[index_]; }
  Schema& schema_;
  std::size_t index_;
};

/// The part of a card that does not depend on its struct, so that it is compiled only once.
class CardText {
 public:
  CardText& chapter(std::string_view title);
  CardText& describe(std::string_view text);
  CardText& example(std::string_view lines);
  CardText& numbered();
  CardText& key(std::string_view word);
  CardText& repeated_ids();
  CardText& rows();
  CardText& once();
  CardText& redefines();
  CardText& unite(void (*records_of_deck)(const std::vector<Record*>&, Diagnostics&));

  /// Adds a keyword for a mesh file (Catalogue::read_mesh), allowed only before the first record.
  FieldBuilder add_mesh_file(std::string_view keyword, std::string_view help);

  const Schema& schema() const { return schema_; }

 protected:
  /// Field type and number of values derived from a member's type.
  struct Shape {
    FieldType type;
    int least, most;  ///< how many values
  };
  CardText(std::string_view name, Words synonyms, std::string_view summary, std::function<std::any()> make);
  Field& add_field(std::string_view keyword, std::string_view help, Shape shape, std::function<Member(std::any&)> bind);
  FieldBuilder last_field();

  Schema schema_;
};

/// Declares a card once and binds every keyword to a member of `Data`.
///
///     Card<SpringData> card("SPRING", {"RESSORT"}, "Spring and damper between two nodes");
///     card.add("K", &SpringData::stiffness, "stiffness").unit(dimension::stiffness).at_least(0);
///
/// The member's type fixes the field's type: bool flag; int, std::vector<int>, std::array<int, N> integers;
/// double, std::optional<double>, std::vector<double>, std::array<double, N> reals; std::string text; Tagged choice.
/// The defaults shown to the user are those of a default-constructed `Data`, or of the struct given to initial().
template <class Data>
class Card : public CardText {
 public:
  Card(std::string_view name, Words synonyms, std::string_view summary)
      : CardText(name, synonyms, summary, [] { return std::any(Data{}); }) {}

  /// `Owner` is Data or a base class of it.
  template <class M, class Owner>
  FieldBuilder add(std::string_view keyword, M Owner::*member, std::string_view help) {
    static_assert(std::is_base_of_v<Owner, Data>, "a keyword binds to a member of the card's own struct");
    add_field(keyword, help, shape(static_cast<M*>(nullptr)),
              [member](std::any& data) { return reference(std::any_cast<Data&>(data).*member); });
    return last_field();
  }

  /// Adds a keyword for one entry of an array that another keyword sets as a whole: `Y` for entry 1 of `X`.
  template <class Value, std::size_t N>
  FieldBuilder add_part(std::string_view keyword, std::string_view whole, std::size_t part, std::array<Value, N> Data::*member,
                        std::string_view help) {
    Field& field = add_field(keyword, help, shape(static_cast<Value*>(nullptr)),
                             [member, part](std::any& data) { return reference((std::any_cast<Data&>(data).*member)[part]); });
    field.whole = whole;
    field.part = static_cast<int>(part);
    return last_field();
  }

  /// Sets the struct a record starts from, if not a default-constructed Data.
  void initial(const Data& data) {
    schema_.make = [data] { return std::any(data); };
  }
  /// Sets `check(Data&, Record&, Diagnostics&)`, which runs after a record has been read without a fault.
  template <class Check>
  void finish(Check check) {
    schema_.finish = [check](Record& record, Diagnostics& diagnostics) {
      check(std::any_cast<Data&>(record.data), record, diagnostics);
    };
  }

 private:
  static constexpr Shape shape(bool*) { return {FieldType::flag, 0, 0}; }
  static constexpr Shape shape(int*) { return {FieldType::integer, 1, 1}; }
  static constexpr Shape shape(double*) { return {FieldType::real, 1, 1}; }
  static constexpr Shape shape(std::string*) { return {FieldType::text, 1, 1}; }
  static constexpr Shape shape(Tagged*) { return {FieldType::choice, 0, 0}; }  // each option gives the number of its values
  template <class Value>
  static constexpr Shape shape(std::optional<Value>*) {
    return shape(static_cast<Value*>(nullptr));
  }
  template <class Value>
  static constexpr Shape shape(std::vector<Value>*) {
    return {shape(static_cast<Value*>(nullptr)).type, 1, any_number};
  }
  template <class Value, std::size_t N>
  static constexpr Shape shape(std::array<Value, N>*) {
    return {shape(static_cast<Value*>(nullptr)).type, N, N};
  }

  template <class M>
  static Member reference(M& member) {
    return &member;
  }
  template <class Value, std::size_t N>
  static Member reference(std::array<Value, N>& member) {
    return std::span<Value>(member);
  }
};

}  // namespace engrane::deck
