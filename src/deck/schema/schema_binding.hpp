// SPDX-License-Identifier: BSD-3-Clause
// How a Card binds a keyword to a member of its struct. Included by schema.hpp only.
#pragma once

#include <cmath>

namespace engrane::deck {

namespace detail {

template <class M>
struct is_array : std::false_type {};
template <class V, std::size_t N>
struct is_array<std::array<V, N>> : std::true_type {};
template <class M>
struct is_vector : std::false_type {};
template <class V>
struct is_vector<std::vector<V>> : std::true_type {};
template <class M>
struct is_optional : std::false_type {};
template <class V>
struct is_optional<std::optional<V>> : std::true_type {};

/// Number of values a list member may take when the declaration does not say.
inline constexpr int any_number = 1 << 20;

/// Sets type and count of a field from its member's type.
template <class M>
void shape_field(Field& field) {
  if constexpr (std::is_same_v<M, bool>) {
    field.type = FieldType::flag;
    field.min_values = field.max_values = 0;
  } else if constexpr (std::is_same_v<M, std::string>) {
    field.type = FieldType::text;
  } else if constexpr (std::is_same_v<M, Tagged>) {
    field.type = FieldType::choice;
    field.min_values = field.max_values = 0;  // an option says how many numbers follow it
  } else if constexpr (is_optional<M>::value) {
    shape_field<typename M::value_type>(field);
  } else if constexpr (is_array<M>::value) {
    shape_field<typename M::value_type>(field);
    field.min_values = field.max_values = static_cast<int>(std::tuple_size_v<M>);
  } else if constexpr (is_vector<M>::value) {
    shape_field<typename M::value_type>(field);
    field.min_values = 1;
    field.max_values = any_number;
  } else if constexpr (std::is_integral_v<M>) {
    field.type = FieldType::integer;
  } else {
    static_assert(std::is_same_v<M, double>, "a card's member is bool, int, double, string, Tagged, or a list of these");
    field.type = FieldType::real;
  }
}

template <class M>
void store_values(M& member, const Field::Values& values) {
  if constexpr (std::is_same_v<M, bool>) {
    member = true;
  } else if constexpr (std::is_same_v<M, std::string>) {
    member = values.texts.front();
  } else if constexpr (std::is_same_v<M, Tagged>) {
    member = Tagged{values.tag, values.numbers};
  } else if constexpr (is_optional<M>::value) {
    typename M::value_type inner{};
    store_values(inner, values);
    member = std::move(inner);
  } else if constexpr (is_vector<M>::value && std::is_same_v<M, std::vector<std::string>>) {
    member = values.texts;
  } else if constexpr (is_array<M>::value || is_vector<M>::value) {
    if constexpr (is_vector<M>::value) member.resize(values.numbers.size());
    for (std::size_t i = 0; i < member.size() && i < values.numbers.size(); ++i)
      member[i] = static_cast<typename M::value_type>(values.numbers[i]);
  } else {
    member = static_cast<M>(values.numbers.front());
  }
}

template <class M>
Field::Values load_values(const M& member) {
  Field::Values values;
  values.present = true;
  if constexpr (std::is_same_v<M, bool>) {
    values.present = member;
  } else if constexpr (std::is_same_v<M, std::string>) {
    values.present = !member.empty();
    values.texts = {member};
  } else if constexpr (std::is_same_v<M, Tagged>) {
    values.present = member.given();
    values.tag = member.tag;
    values.numbers = member.values;
  } else if constexpr (is_optional<M>::value) {
    if (!member) {
      values.present = false;
    } else {
      values = load_values(*member);
      values.present = true;
    }
  } else if constexpr (is_vector<M>::value && std::is_same_v<M, std::vector<std::string>>) {
    values.present = !member.empty();
    values.texts = member;
  } else if constexpr (is_array<M>::value || is_vector<M>::value) {
    values.present = !member.empty();
    for (const auto& v : member) values.numbers.push_back(static_cast<double>(v));
  } else {
    values.numbers = {static_cast<double>(member)};
  }
  return values;
}

}  // namespace detail

template <class Data>
template <class Member, class Owner>
FieldBuilder Card<Data>::add(std::string keyword, Member Owner::*member, std::string help) {
  static_assert(std::is_base_of_v<Owner, Data>, "a keyword binds to a member of the card's own struct");
  Field field;
  field.keyword = std::move(keyword);
  field.spellings = collect_spellings(field);
  field.help = std::move(help);
  detail::shape_field<Member>(field);
  field.store = [member](std::any& data, const Field::Values& values) {
    detail::store_values(std::any_cast<Data&>(data).*member, values);
  };
  field.load = [member](const std::any& data) { return detail::load_values(std::any_cast<const Data&>(data).*member); };
  schema_.fields.push_back(std::move(field));
  return FieldBuilder(schema_, schema_.fields.size() - 1);
}

template <class Data>
template <class Member>
FieldBuilder Card<Data>::add_part(std::string keyword, std::string whole, int part, Member Data::*member, std::string help) {
  static_assert(detail::is_array<Member>::value, "only an array has parts");
  Field field;
  field.keyword = std::move(keyword);
  field.spellings = collect_spellings(field);
  field.help = std::move(help);
  detail::shape_field<typename Member::value_type>(field);
  field.whole = std::move(whole);
  field.part = part;
  field.store = [member, part](std::any& data, const Field::Values& values) {
    detail::store_values((std::any_cast<Data&>(data).*member)[static_cast<std::size_t>(part)], values);
  };
  field.load = [](const std::any&) { return Field::Values{}; };  // the whole is written out, not its parts
  schema_.fields.push_back(std::move(field));
  return FieldBuilder(schema_, schema_.fields.size() - 1);
}

template <class Data>
FieldBuilder Card<Data>::add_mesh_file(std::string keyword, std::string help) {
  Field field;
  field.keyword = std::move(keyword);
  field.spellings = collect_spellings(field);
  field.help = std::move(help);
  field.type = FieldType::text;
  field.heading = field.mesh_file = true;
  field.store = [](std::any&, const Field::Values&) {};
  field.load = [](const std::any&) { return Field::Values{}; };  // the records are written out, not the name
  schema_.fields.push_back(std::move(field));
  return FieldBuilder(schema_, schema_.fields.size() - 1);
}

template <class Data>
template <class Check>
Card<Data>& Card<Data>::finish(Check check) {
  schema_.finish = [check](Record& record, Diagnostics& diagnostics) {
    check(std::any_cast<Data&>(record.data), record, diagnostics);
  };
  return *this;
}

}  // namespace engrane::deck
