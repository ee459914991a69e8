// How a table of keys is written: row(path, type, meaning, ...).required().only(...).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/key_table.h"

namespace scree {

class KeyRow {
 public:
  explicit KeyRow(Key key) : key_(std::move(key)) {}

  KeyRow required() const {
    return with([](Key& key) { key.required = true; });
  }
  KeyRow count(Count count) const {
    return with([&](Key& key) { key.count = count; });
  }
  KeyRow range(Range range) const {
    return with([&](Key& key) { key.range = range; });
  }
  KeyRow depends(Depends depends) const {
    return with([&](Key& key) { key.depends = depends; });
  }
  KeyRow words(std::vector<std::string> words) const {
    return with([&](Key& key) { key.words = words; });
  }
  KeyRow fallback(std::string yaml) const {
    return with([&](Key& key) { key.fallback = yaml; });
  }
  KeyRow otherwise(std::string what) const {
    return with([&](Key& key) { key.otherwise = what; });
  }
  KeyRow choice(std::string name) const {
    return with([&](Key& key) { key.choice = name; });
  }
  KeyRow only(std::vector<Condition> conditions) const {
    return with([&](Key& key) { key.only = conditions; });
  }

  operator Key() const { return key_; }  // NOLINT(google-explicit-constructor): a row stands for its key in a list of keys

 private:
  template <class Change>
  KeyRow with(const Change& change) const {
    Key changed = key_;
    change(changed);
    return KeyRow(std::move(changed));
  }

  Key key_;
};

inline KeyRow row(std::string path, KeyType type, std::string meaning, Quantity quantity = quantity::number, Range range = {}) {
  Key key;
  key.path = std::move(path);
  key.type = type;
  key.meaning = std::move(meaning);
  key.quantity = quantity;
  key.range = range;
  return KeyRow(std::move(key));
}

}  // namespace scree
