#include "coupling/plugin/dictionary_tree.hpp"

#include <cstdint>

#include "ITstream.H"
#include "OSspecific.H"
#include "OStringStream.H"

namespace hemoscale::coupling {
namespace {

using Kind = ParameterTree::Kind;
using Tokens = Foam::tokenList;

int line_or_unknown(Foam::label line) {
  return line > 0 ? static_cast<int>(line) : 0;
}

/// The file an entry was read from. Its stream is named after the file and the dictionaries around
/// it, "/case/system/controlDict.functions.hemoscale.key", from v2006 on with slashes: what is left
/// after taking parts off the end, until it is a file.
std::string file_of(const Foam::entry& entry) {
  const std::string whole = entry.stream().name();
  std::string name = whole;
  while (!Foam::isFile(Foam::fileName(name), false)) {
    const std::size_t separator = name.find_last_of("./");
    if (separator == std::string::npos || separator == 0) return whole;
    name.resize(separator);
  }
  return name;
}

std::string text_of(const Foam::token& token) {
  if (token.isWord()) return token.wordToken();
  if (token.isString()) return token.stringToken();
  Foam::OStringStream stream;
  stream << token;
  return stream.str();
}

ParameterTree scalar_tree(ParameterTree::Scalar value, const Location& location) {
  ParameterTree tree;
  tree.kind = Kind::scalar;
  tree.location = location;
  tree.scalar = std::move(value);
  return tree;
}

ParameterTree one_value(const Foam::token& token, const Location& location) {
  if (token.isLabel()) return scalar_tree(std::int64_t{token.labelToken()}, location);
  if (token.isNumber()) return scalar_tree(double{token.number()}, location);
  return scalar_tree(text_of(token), location);
}

/// Reads what stands between the bracket before `position` and its partner, and steps behind it.
ParameterTree list_value(const Tokens& tokens, Foam::label& position, const Location& location) {
  ParameterTree list;
  list.kind = Kind::list;
  list.location = location;
  while (position < tokens.size()) {
    const Foam::token& token = tokens[position++];
    Location here = location;
    here.line = line_or_unknown(token.lineNumber());
    if (token.isPunctuation() && token.pToken() == Foam::token::END_LIST) break;
    if (token.isPunctuation() && token.pToken() == Foam::token::BEGIN_LIST) {
      list.elements.push_back(list_value(tokens, position, here));
    } else {
      list.elements.push_back(one_value(token, here));
    }
  }
  return list;
}

ParameterTree entry_value(const Foam::entry& entry) {
  const Foam::ITstream& stream = entry.stream();
  const Tokens& tokens = stream;
  Location location;
  location.file = file_of(entry);
  location.line = line_or_unknown(entry.startLineNumber());
  if (tokens.size() == 1) return one_value(tokens[0], location);
  if (tokens.size() > 1 && tokens[0].isPunctuation() &&
      tokens[0].pToken() == Foam::token::BEGIN_LIST) {
    Foam::label position = 1;
    return list_value(tokens, position, location);
  }
  std::string text;
  for (const Foam::token& token : tokens) text += (text.empty() ? "" : " ") + text_of(token);
  return scalar_tree(text, location);
}

/// The first line and the file of what a dictionary holds; a dictionary itself does not know them.
Location place_of(const Foam::dictionary& dictionary) {
  Location location;
  location.line = line_or_unknown(dictionary.startLineNumber());
  for (const Foam::entry& entry : dictionary) {
    location.file = entry.isDict() ? place_of(entry.dict()).file : file_of(entry);
    if (!location.file.empty()) break;
  }
  return location;
}

}  // namespace

ParameterTree read_dictionary(const Foam::dictionary& dictionary,
                              const std::set<std::string>& left_out) {
  ParameterTree table;
  table.location = place_of(dictionary);
  for (const Foam::entry& entry : dictionary) {
    const std::string key = entry.keyword();
    if (left_out.count(key) > 0) continue;
    table.children.emplace_back(
        key, entry.isDict() ? read_dictionary(entry.dict(), {}) : entry_value(entry));
  }
  return table;
}

}  // namespace hemoscale::coupling
