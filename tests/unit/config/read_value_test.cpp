#include "coupling/config/read_value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hemoscale::coupling {
namespace {

using Kind = ParameterKind;
using Tree = ParameterTree;
using testing::HasSubstr;

Tree scalar(Tree::Scalar value) {
  Tree tree;
  tree.kind = Tree::Kind::scalar;
  tree.location = {"case.toml", 7, 9};
  tree.scalar = std::move(value);
  return tree;
}

Tree word(const std::string& text) {
  return scalar(text);
}

Tree list(std::vector<Tree> elements) {
  Tree tree;
  tree.kind = Tree::Kind::list;
  tree.location = {"case.toml", 7, 9};
  tree.elements = std::move(elements);
  return tree;
}

Tree section() {
  Tree tree;
  tree.location = {"case.toml", 7, 9};
  return tree;
}

/// What one read gives: the value, or the messages.
struct Read {
  std::optional<Settings::Value> value;
  std::vector<Fault> faults;

  std::string message() const { return faults.empty() ? "" : faults.front().message; }
};

Read read(const Parameter& parameter, const Tree& tree) {
  Read result;
  ValueReader reader(result.faults);
  result.value = reader.read(parameter, "a.key", tree);
  EXPECT_EQ(result.value.has_value(), result.faults.empty());
  for (const Fault& fault : result.faults) {
    EXPECT_EQ(fault.key, "a.key");
    EXPECT_EQ(fault.file, "case.toml");
    EXPECT_EQ(fault.line, 7);
    EXPECT_EQ(fault.column, 9);
  }
  return result;
}

double real(const Parameter& parameter, const Tree& tree) {
  const Read result = read(parameter, tree);
  EXPECT_TRUE(result.value) << result.message();
  return result.value ? std::get<double>(*result.value) : std::nan("");
}

const Parameter length{.key = "a.key", .kind = Kind::quantity, .unit = "m"};
const Parameter number{.key = "a.key", .kind = Kind::number};
const Parameter count{.key = "a.key", .kind = Kind::integer};
const Parameter flag{.key = "a.key", .kind = Kind::boolean};
const Parameter text{.key = "a.key", .kind = Kind::text};
const Parameter name{.key = "a.key", .kind = Kind::name};
const Parameter animal{.key = "a.key", .kind = Kind::choice, .choices = {"cat", "dog"}};
const Parameter lengths{.key = "a.key", .kind = Kind::quantity_list, .unit = "m"};
const Parameter places{.key = "a.key", .kind = Kind::points, .unit = "m"};

TEST(ReadValue, quantity_with_and_without_unit) {
  EXPECT_EQ(real(length, word("80 um")), 80e-6);
  EXPECT_EQ(real(length, word("80um")), 80e-6);
  EXPECT_EQ(real(length, word("  +8e1 \t um ")), 80e-6);
  EXPECT_EQ(real(length, word("-1.5 m")), -1.5);
  EXPECT_EQ(real(length, scalar(0.25)), 0.25);
  EXPECT_EQ(real(length, scalar(std::int64_t{3})), 3);
  EXPECT_EQ(real(length, word("0.25")), 0.25);  // a word of an OpenFOAM dictionary, SI
  EXPECT_EQ(real({.kind = Kind::quantity, .unit = "1/s"}, word("5 /s")), 5);
}

TEST(ReadValue, quantity_refuses) {
  EXPECT_THAT(read(length, word("5 kg")).message(), HasSubstr("cannot be converted to m"));
  EXPECT_THAT(read(length, word("5 umm")).message(), HasSubstr("is not known"));
  EXPECT_THAT(read(length, word("um")).message(), HasSubstr("does not begin with a number"));
  EXPECT_THAT(read(length, word("")).message(), HasSubstr("does not begin with a number"));
  EXPECT_THAT(read(length, word("+-5 um")).message(), HasSubstr("does not begin with a number"));
  EXPECT_THAT(read(length, word("5 %")).message(), HasSubstr("cannot be converted to m"));
  EXPECT_THAT(read(length, word("1e999 m")).message(), HasSubstr("too large or too small"));
  EXPECT_THAT(read(length, word("1e308 Mm")).message(), HasSubstr("not finite"));
  EXPECT_THAT(read(length, word("1,5 um")).message(), HasSubstr("\",5 um\""));
  EXPECT_THAT(read(length, word("nan m")).message(), HasSubstr("not finite"));
  EXPECT_THAT(read(length, word("inf")).message(), HasSubstr("not finite"));
  EXPECT_THAT(read(length, scalar(std::nan(""))).message(), HasSubstr("not finite"));
  EXPECT_THAT(read(length, scalar(-std::numeric_limits<double>::infinity())).message(),
              HasSubstr("not finite"));
  EXPECT_THAT(read(length, scalar(true)).message(), HasSubstr("expected a quantity in m"));
  EXPECT_THAT(read(length, list({})).message(), HasSubstr("expected a quantity in m"));
  EXPECT_THAT(read(length, section()).message(), HasSubstr("a section"));
  const Parameter temperature{.key = "a.key", .kind = Kind::quantity, .unit = "K"};
  EXPECT_THAT(read(temperature, word("37 degC")).message(), HasSubstr("origin"));
}

TEST(ReadValue, number_takes_no_unit) {
  EXPECT_EQ(real(number, scalar(0.4)), 0.4);
  EXPECT_EQ(real(number, word("0.4")), 0.4);
  EXPECT_DOUBLE_EQ(real(number, word("45 %")), 0.45);
  EXPECT_THAT(read(number, word("0.4 m")).message(), HasSubstr("is not dimensionless"));
  EXPECT_THAT(read(number, word("much")).message(), HasSubstr("expected a number"));
}

TEST(ReadValue, range_ends_are_open_or_closed) {
  Parameter p = number;
  p.range = {.lowest = 0, .highest = 2, .lowest_allowed = false};
  EXPECT_FALSE(read(p, scalar(0.0)).value);
  EXPECT_TRUE(read(p, scalar(1e-300)).value);
  EXPECT_TRUE(read(p, scalar(2.0)).value);
  EXPECT_FALSE(read(p, scalar(std::nextafter(2.0, 3.0))).value);
  p.range = {.lowest = 0, .highest = 1, .highest_allowed = false};
  EXPECT_TRUE(read(p, scalar(0.0)).value);
  EXPECT_FALSE(read(p, scalar(-1e-300)).value);
  EXPECT_FALSE(read(p, scalar(1.0)).value);
  EXPECT_EQ(read(p, scalar(3.0)).message(), "3 is out of range; allowed is >= 0 and < 1");

  Parameter q = length;
  q.range = {.lowest = 1e-7, .highest = 1};
  EXPECT_EQ(read(q, word("-1 um")).message(),
            "\"-1 um\" = -1e-06 m is out of range; allowed is 1e-07 to 1 m");
}

TEST(ReadValue, integer) {
  const auto whole = [](const Tree& tree) {
    return std::get<std::int64_t>(read(count, tree).value.value());
  };
  EXPECT_EQ(whole(scalar(std::int64_t{24})), 24);
  EXPECT_EQ(whole(word("24")), 24);
  EXPECT_EQ(whole(scalar(1e6)), 1000000);
  EXPECT_EQ(whole(word("1e6")), 1000000);
  const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(whole(scalar(largest)), largest);
  EXPECT_EQ(whole(word(std::to_string(largest))), largest);
  for (const Tree& tree :
       {scalar(2.5), word("2.5"), word("99999999999999999999"), scalar(1e300), word("24 um"),
        word("many"), word(""), scalar(true), scalar(std::nan("")), list({})}) {
    EXPECT_THAT(read(count, tree).message(), HasSubstr("expected a whole number")) << shown(tree);
  }
  Parameter small = count;
  small.range = {.lowest = 1, .highest = 4096};
  EXPECT_TRUE(read(small, scalar(std::int64_t{4096})).value);
  EXPECT_THAT(read(small, scalar(largest)).message(), HasSubstr("allowed is 1 to 4096"));
}

TEST(ReadValue, boolean) {
  for (const Tree& tree : {scalar(true), word("true"), word("yes"), word("on")}) {
    EXPECT_TRUE(std::get<bool>(read(flag, tree).value.value()));
  }
  for (const Tree& tree : {scalar(false), word("false"), word("no"), word("off")}) {
    EXPECT_FALSE(std::get<bool>(read(flag, tree).value.value()));
  }
  for (const Tree& tree :
       {word("maybe"), word(""), scalar(std::int64_t{1}), scalar(0.0), list({})}) {
    EXPECT_THAT(read(flag, tree).message(), HasSubstr("expected true or false"));
  }
}

TEST(ReadValue, text_name_and_choice) {
  EXPECT_EQ(std::get<std::string>(read(text, word("a b\nc")).value.value()), "a b\nc");
  EXPECT_THAT(read(text, word("  ")).message(), HasSubstr("empty"));
  EXPECT_THAT(read(text, word("bell\a")).message(), HasSubstr("control characters"));
  EXPECT_THAT(read(text, scalar(3.0)).message(), HasSubstr("expected text"));
  Parameter optional = text;
  optional.default_value = "";
  EXPECT_TRUE(read(optional, word("")).value);

  EXPECT_TRUE(read(name, word("Case_1-b")).value);
  for (const char* wrong : {"a b", "../a", "a/b", "", "a\n", "ä"}) {
    EXPECT_FALSE(read(name, word(wrong)).value) << wrong;
  }
  EXPECT_TRUE(read(name, word(std::string(64, 'a'))).value);
  EXPECT_FALSE(read(name, word(std::string(65, 'a'))).value);

  EXPECT_TRUE(read(animal, word("dog")).value);
  EXPECT_EQ(read(animal, word("dgo")).message(),
            "\"dgo\" is not one of cat, dog; did you mean \"dog\"?");
  EXPECT_THAT(read(animal, scalar(std::int64_t{1})).message(), HasSubstr("one of cat, dog"));
}

TEST(ReadValue, lists_and_points) {
  const auto values = read(lengths, list({word("1 um"), scalar(2.0), word("3")})).value;
  EXPECT_EQ(std::get<std::vector<double>>(values.value()), (std::vector<double>{1e-6, 2, 3}));
  EXPECT_FALSE(read(lengths, list({})).value);
  EXPECT_EQ(read(lengths, list({word("a"), scalar(2.0), word("b")})).faults.size(), 2U);
  EXPECT_FALSE(read(lengths, scalar(2.0)).value);

  const Tree point = list({word("1 um"), scalar(std::int64_t{2}), word("3 mm")});
  const auto points = std::get<Settings::Points>(read(places, list({point, point})).value.value());
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1], Eigen::Vector3d(1e-6, 2, 3e-3));
  EXPECT_FALSE(read(places, list({})).value);
  EXPECT_FALSE(read(places, point).value);
  EXPECT_THAT(read(places, list({point, list({scalar(1.0)})})).message(),
              HasSubstr("point 2 is a list of 1"));
  Parameter pair = places;
  pair.length = 2;
  EXPECT_TRUE(read(pair, list({point, point})).value);
  EXPECT_THAT(read(pair, list({point})).message(), HasSubstr("expected a list of 2 points"));
}

TEST(ReadValue, messages_are_short_and_printable) {
  const std::string message = read(length, word("\x1b[31m" + std::string(10000, 'x'))).message();
  EXPECT_LT(message.size(), 300U);
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace hemoscale::coupling
