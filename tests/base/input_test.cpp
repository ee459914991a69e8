#include "engine/base/input.h"

#include <concepts>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace scree {

namespace {

template <std::invocable Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string message_of(const std::string& text) {
  return message_of([&] { parse_yaml(text, "s.yaml"); });
}

std::string place(const InputValue& value) {
  return to_string(value.where);
}

TEST(Input, EveryValueKnowsItsPlace) {
  const InputValue root = parse_yaml("a: 1\nb:\n  c: [x, {d: 12 h}]\n", "s.yaml");
  EXPECT_EQ(place(*root.find("a")), "s.yaml:1:4");
  const InputValue& c = *root.find("b")->find("c");
  EXPECT_EQ(place(c.items[0]), "s.yaml:3:7");
  EXPECT_EQ(c.items[1].find("d")->text, "12 h");
  EXPECT_EQ(to_string(c.items[1].entries[0].where), "s.yaml:3:11");
}

TEST(Input, WhatIsEmptyIsAtItsKeyNotAtTheNextThing) {
  const InputValue root = parse_yaml("a:\n\nb:\n  c:\n# more\n  d: 1\n", "s.yaml");
  EXPECT_EQ(place(*root.find("a")), "s.yaml:1:1");
  EXPECT_EQ(place(*root.find("b")->find("c")), "s.yaml:4:3");
}

TEST(Input, ALongTextIsCutBetweenItsCharacters) {
  InputValue value;
  value.kind = InputValue::Kind::scalar;
  value.text = std::string(59, 'a') + "\u00e9 and so on";
  EXPECT_EQ(describe(value), std::string(59, 'a') + "...");
  value.text = std::string(58, 'a') + "\u00e9 and so on";
  EXPECT_EQ(describe(value), std::string(58, 'a') + "\u00e9...");
}

TEST(Input, AliasesAreCopied) {
  const InputValue root = parse_yaml("a: &x {d: 1}\nb: *x\n", "s.yaml");
  EXPECT_EQ(root.find("b")->find("d")->text, "1");
}

TEST(Input, TextOfAnotherEncodingIsRefusedWhereItStands) {
  const std::string said = " the file is no UTF-8 text. Save it as UTF-8; a byte there belongs to another encoding";
  EXPECT_EQ(message_of("a: 1\ntitle: K\xfchlung\n"), "s.yaml:2:8:" + said);
  EXPECT_EQ(message_of("K\xfchlung: 1\n"), "s.yaml:1:1:" + said);
  EXPECT_EQ(parse_yaml("title: K\xc3\xbchlung  # K\xfchl\n", "s.yaml").find("title")->text, "K\xc3\xbchlung");
}

TEST(Input, AnEmptyFileIsEmpty) {
  EXPECT_EQ(parse_yaml("", "s.yaml").kind, InputValue::Kind::empty);
  EXPECT_EQ(parse_yaml("# nothing\n", "s.yaml").kind, InputValue::Kind::empty);
}

TEST(Input, SyntaxErrorsTellTheirPlace) {
  EXPECT_EQ(message_of("a: [1, 2\nb: 3\n"), "s.yaml:2:2: the file is not YAML (end of sequence flow not found)");
  EXPECT_EQ(message_of("a: b: c"), "s.yaml:1:5: the file is not YAML (illegal map value)");
  EXPECT_THAT(message_of("a:\n  b: 1\n\tc: 2\n"), testing::EndsWith("). Indent with spaces: YAML takes no tabs there"));
  EXPECT_EQ(message_of("a: *b"), "s.yaml:1:4: the file is not YAML (the referenced anchor is not defined)");
}

TEST(Input, NamesGivenTwiceAreAllFound) {
  EXPECT_EQ(message_of("a: 1\nb: {x: 1, x: 2}\na: 3\n"),
            "s.yaml:2:11: x is given twice (the first is at line 2). Keep one of them\n"
            "s.yaml:3:1: a is given twice (the first is at line 1). Keep one of them");
}

TEST(Input, OddFilesAreRefused) {
  EXPECT_EQ(message_of("--- 1\n--- 2\n"),
            "s.yaml:2:5: the file is more than one YAML document. Keep the part before the line ---");
  EXPECT_EQ(message_of("? [1]\n: 2\n"), "s.yaml:1:3: a key is not a word. Write a name before the colon");
  EXPECT_EQ(message_of("a: &x [*x]\n"), "s.yaml:1:4: the file is too deeply nested. Look for an alias that holds itself");
  std::string nested = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) nested += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  EXPECT_THAT(message_of(nested), testing::HasSubstr("too large"));
  EXPECT_THAT(message_of(std::string(100000, '[')), testing::HasSubstr("is not YAML"));
}

TEST(Input, AMissingFileSaysSo) {
  EXPECT_EQ(message_of([] { read_yaml("/nowhere/s.yaml"); }),
            "/nowhere/s.yaml: the file is not readable (No such file or directory)");
  EXPECT_EQ(message_of([] { read_yaml("/"); }), "/: the file is not readable (a folder)");
  EXPECT_EQ(message_of([] { read_yaml("/dev/zero"); }),
            "/dev/zero: the file is not readable (more than 256 MB). Name a file of text");
}

TEST(Override, SetsReplacesAndTakesAway) {
  InputValue root = parse_yaml("a: {b: 1, c: [1, {d: 2}]}\n", "s.yaml");
  apply_override(root, "a.b=12 h");
  EXPECT_EQ(root.find("a")->find("b")->text, "12 h");
  EXPECT_EQ(place(*root.find("a")->find("b")), "--set a.b");
  apply_override(root, "a.c[1].d=5");
  EXPECT_EQ(root.find("a")->find("c")->items[1].find("d")->text, "5");
  apply_override(root, "a.c.0={e: x=y}");
  EXPECT_EQ(root.find("a")->find("c")->items[0].find("e")->text, "x=y");
  apply_override(root, "new.deep.key=[1, 2]");
  EXPECT_EQ(root.find("new")->find("deep")->find("key")->items.size(), 2u);
  apply_override(root, "a.b=null");
  EXPECT_EQ(root.find("a")->find("b"), nullptr);
  apply_override(root, "a.c[0]=null");
  EXPECT_EQ(root.find("a")->find("c")->items.size(), 1u);
  apply_override(root, "not.there=null");
  EXPECT_EQ(root.find("not"), nullptr);
}

TEST(Override, WrongOnesAreRefused) {
  InputValue root = parse_yaml("a: {b: 1, c: [1]}\n", "s.yaml");
  const auto message = [&](const std::string& assignment) { return message_of([&] { apply_override(root, assignment); }); };
  EXPECT_EQ(message("a.b"), "--set a.b: a.b is not understood (must be key.path=value)");
  EXPECT_EQ(message("=3"), "--set =3: =3 is not understood (must be key.path=value)");
  EXPECT_EQ(message("a..b=3"), "--set a..b=3: a..b=3 is not understood (must be key.path=value)");
  EXPECT_EQ(message("a.b="), "--set a.b: a.b is empty (null takes a key away)");
  EXPECT_EQ(message("a.b=#none"), "--set a.b: a.b is #none (null takes a key away)");
  EXPECT_EQ(message("a.b.c=1"), "--set a.b.c: a.b.c is not there (c would be inside 1)");
  EXPECT_EQ(message("a.c[1]=1"), "--set a.c[1]: a.c[1] is not there (1 is no item of a list of 1, counted from 0)");
  EXPECT_EQ(message("a.c.x=1"), "--set a.c.x: a.c.x is not there (x is no item of a list of 1, counted from 0)");
  EXPECT_EQ(message("a.b=[1"), "--set a.b:1:1: the file is not YAML (end of sequence flow not found)");
}

}  // namespace

}  // namespace scree
