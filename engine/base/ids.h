// Typed ids: an index into one kind of table cannot be used for another.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace scree {

// A position in a table of `Tag`s, counted from 0.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(std::size_t index) : value_(static_cast<std::int32_t>(index)) {}

  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value_); }
  [[nodiscard]] constexpr std::int32_t value() const { return value_; }
  [[nodiscard]] constexpr bool valid() const { return value_ >= 0; }

  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  std::int32_t value_ = -1;
};

using MaterialId = Id<struct MaterialTag>;
using BodyId = Id<struct BodyTag>;
using BlockId = Id<struct BlockTag>;
using ElementId = Id<struct ElementTag>;
using NodeId = Id<struct NodeTag>;
using FaceId = Id<struct FaceTag>;
using CellId = Id<struct CellTag>;
using SurfaceId = Id<struct SurfaceTag>;

// Consecutive ids [first, last).
template <class IdType>
class IdRange {
 public:
  class Iterator {
   public:
    using value_type = IdType;
    using difference_type = std::ptrdiff_t;
    Iterator() = default;
    explicit Iterator(std::size_t at) : at_(at) {}
    IdType operator*() const { return IdType{at_}; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++at_;
      return before;
    }
    friend bool operator==(Iterator, Iterator) = default;

   private:
    std::size_t at_ = 0;
  };

  IdRange() = default;
  IdRange(std::size_t first, std::size_t last) : first_(first), last_(last) {}

  [[nodiscard]] Iterator begin() const { return Iterator{first_}; }
  [[nodiscard]] Iterator end() const { return Iterator{last_}; }
  [[nodiscard]] std::size_t size() const { return last_ - first_; }
  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t last() const { return last_; }
  IdType operator[](std::size_t offset) const { return IdType{first_ + offset}; }
  friend bool operator==(IdRange, IdRange) = default;

 private:
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

// A vector that is indexed by one kind of id only.
template <class IdType, class T, class Vector = std::vector<T>>
class Table {
 public:
  Table() = default;
  explicit Table(std::size_t size) : data_(size) {}
  Table(std::size_t size, const T& value) : data_(size, value) {}
  explicit Table(Vector data) : data_(std::move(data)) {}

  decltype(auto) operator[](IdType id) { return data_[id.index()]; }
  decltype(auto) operator[](IdType id) const { return data_[id.index()]; }

  IdType push_back(T value) {
    data_.push_back(std::move(value));
    return IdType{data_.size() - 1};
  }
  void reserve(std::size_t size) { data_.reserve(size); }

  [[nodiscard]] std::size_t size() const { return data_.size(); }
  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] IdRange<IdType> ids() const { return {0, data_.size()}; }
  [[nodiscard]] const Vector& raw() const { return data_; }

  [[nodiscard]] auto begin() { return data_.begin(); }
  [[nodiscard]] auto end() { return data_.end(); }
  [[nodiscard]] auto begin() const { return data_.begin(); }
  [[nodiscard]] auto end() const { return data_.end(); }

  friend bool operator==(const Table&, const Table&) = default;

 private:
  Vector data_;
};

}  // namespace scree

template <class Tag>
struct std::hash<scree::Id<Tag>> {
  std::size_t operator()(scree::Id<Tag> id) const noexcept { return id.index(); }
};
