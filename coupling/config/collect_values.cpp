#include "coupling/config/collect_values.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <utility>

#include "coupling/config/nearest_key.hpp"

namespace hemoscale::coupling {

namespace {

using Tree = ParameterTree;

constexpr const char* variant_section = "variant";

/// A key as it may appear in a message: user's text is not printed unseen.
std::string printable(const std::string& key) {
  constexpr std::size_t longest = 100;  // [-] bytes
  std::string text = key.substr(0, longest);
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return key.size() > longest ? text + "..." : text;
}

class Collector {
 public:
  Collector(const std::vector<Parameter>& table, ValueReader& reader, std::vector<Fault>& faults)
      : table_(table), reader_(reader), faults_(faults) {
    for (const Parameter& parameter : table) {
      parameters_.emplace(parameter.key, &parameter);
      for (std::size_t dot = parameter.key.find('.'); dot != std::string::npos;
           dot = parameter.key.find('.', dot + 1)) {
        sections_.insert(parameter.key.substr(0, dot));
      }
    }
  }

  Layers collect(const Tree& tree) {
    Layers layers;
    collect_table(tree, "", "", layers.base);
    for (const auto& [name, child] : tree.children) {
      if (name == variant_section) collect_variants(child, layers);
    }
    return layers;
  }

 private:
  void collect_variants(const Tree& variants, Layers& layers) {
    if (variants.kind != Tree::Kind::table) {
      add(variants.location, variant_section,
          "is not a section; write [variant.NAME] followed by the keys that differ");
      return;
    }
    std::set<std::string> seen;
    for (const auto& [name, tree] : variants.children) {
      const std::string prefix = std::string(variant_section) + "." + printable(name);
      if (!seen.insert(name).second) {
        add(tree.location, prefix, "is given twice; keep one of them");
      } else if (tree.kind != Tree::Kind::table) {
        add(tree.location, prefix,
            "is not a section; write [" + prefix + "] followed by the keys that differ");
      } else {
        Layer layer;
        collect_table(tree, "", prefix + ".", layer);
        if (const auto* given = find(layer, "case.variant")) {
          add(given->location, given->written_key,
              "a variant cannot name another one; remove it, or set it in [case]");
        }
        layers.variants.emplace_back(name, std::move(layer));
      }
    }
  }

  /// @param section       name of this table, empty at the top
  /// @param layer_prefix  "variant.NAME." or empty; stands before keys in messages
  void collect_table(const Tree& tree, const std::string& section, const std::string& layer_prefix,
                     Layer& layer) {
    std::set<std::string> seen;
    for (const auto& [name, child] : tree.children) {
      const bool is_variants = section.empty() && layer_prefix.empty() && name == variant_section;
      std::string key = section;
      key += section.empty() ? "" : ".";
      key += name;
      const std::string written = layer_prefix + printable(key);
      const bool plain = !name.empty() && name.find('.') == std::string::npos;
      const auto parameter = plain ? parameters_.find(key) : parameters_.end();
      if (!seen.insert(name).second) {
        add(child.location, written, "is given twice; keep one of them");
      } else if (is_variants) {
        continue;
      } else if (parameter != parameters_.end()) {
        collect_value(*parameter->second, written, child, layer);
      } else if (plain && sections_.count(key) > 0) {
        collect_section(child, key, layer_prefix, written, layer);
      } else if (!plain) {
        add(child.location, written,
            "is not a known key: names hold no dots or blanks; write nested keys without quotes");
      } else {
        add_unknown(child, key, written, layer);
      }
    }
  }

  void collect_value(const Parameter& parameter, const std::string& written, const Tree& node,
                     Layer& layer) {
    layer.values[parameter.key] = {reader_.read(parameter, written, node), node.location, written};
  }

  void collect_section(const Tree& node, const std::string& section,
                       const std::string& layer_prefix, const std::string& written, Layer& layer) {
    if (node.kind == Tree::Kind::table) {
      layer.sections[section] = node.location;
      collect_table(node, section, layer_prefix, layer);
      return;
    }
    std::string first_key;
    for (const Parameter& parameter : table_) {
      if (first_key.empty() && parameter.key.rfind(section + ".", 0) == 0) {
        first_key = parameter.key;
      }
    }
    add(node.location, written,
        fmt::format("is a section, not a value, got {}; its keys are {} and others", shown(node),
                    first_key));
  }

  void add_unknown(const Tree& node, const std::string& key, const std::string& written,
                   Layer& layer) {
    const Suggestion suggestion = suggest(key, table_);
    if (suggestion.close) layer.probably_misspelled.insert(suggestion.key);
    layer.probably_misspelled.insert(suggestion.elsewhere.begin(), suggestion.elsewhere.end());
    const char* what = node.kind == Tree::Kind::table ? "section" : "key";
    add(node.location, written,
        fmt::format("is not a known {}; {}; `hemoscale reference` lists all", what,
                    suggestion_text(suggestion)));
  }

  static const Given* find(const Layer& layer, const std::string& key) {
    const auto entry = layer.values.find(key);
    return entry == layer.values.end() ? nullptr : &entry->second;
  }

  void add(const Location& location, const std::string& key, const std::string& message) {
    faults_.push_back({location.file, location.line, location.column, key, message});
  }

  const std::vector<Parameter>& table_;
  std::unordered_map<std::string, const Parameter*> parameters_;
  std::set<std::string> sections_;
  ValueReader& reader_;
  std::vector<Fault>& faults_;
};

}  // namespace

Layers collect_values(const ParameterTree& tree, const std::vector<Parameter>& table,
                      ValueReader& reader, std::vector<Fault>& faults) {
  return Collector(table, reader, faults).collect(tree);
}

}  // namespace hemoscale::coupling
