#pragma once
/// The state of an object as bytes: written and read by one list of its members,
///
///     void visit(Archive& state) { state(t_, y_, count_); }
///
/// which stands next to the members. Members may be plain structs and numbers, which go as a whole so that
/// none of their members can be forgotten, Eigen's dense types, strings, optionals, vectors, arrays, and
/// whatever has a `visit` itself. What follows from the deck or is computed anew before it is used is not
/// listed.
///
/// Each piece carries its size, so that a state of another layout is noticed: FileError. Byte order and
/// number formats are the machine's. No serialising library: steppers, motions and watchers are reached
/// through virtual functions, which need one archive type for both directions; what a library would add to
/// that is the few lines below.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace treejet {

class Archive {
 public:
  /// To be written, piece by piece, to where they are taken.
  explicit Archive(std::function<void(std::string_view piece)> take) : take_(std::move(take)) {}
  /// To be read; the bytes outlive the archive.
  explicit Archive(const std::string& bytes) : source_(&bytes) {}

  /// The bytes of some objects.
  template <class... T>
  static std::string bytes_of(T&... objects) {
    std::string bytes;
    Archive([&](std::string_view piece) { bytes += piece; })(objects...);
    return bytes;
  }

  template <class... T>
  void operator()(T&... members) {
    (one(members), ...);
  }

  bool reading() const { return source_ != nullptr; }
  /// All that was written has been read, else FileError.
  void expect_end() const;

 private:
  void block(void* data, std::size_t size);
  /// A byte that is neither 0 nor 1 must not become a bool.
  void truth(bool& value);
  /// The number of elements of `size` bytes each that follow; when writing, `count`.
  std::size_t counted(std::size_t count, std::size_t size);
  /// The number of columns of a table that follows; when writing, `count`.
  std::int64_t counted_columns(std::int64_t count);

  template <class T>
  void one(T& value) {
    if constexpr (requires { [](const Eigen::DenseBase<typename T::PlainObject>&) {}(value); }) {
      constexpr bool any_columns = T::ColsAtCompileTime == Eigen::Dynamic;
      std::int64_t columns = value.cols();
      if constexpr (any_columns) columns = counted_columns(columns);
      const std::size_t row = static_cast<std::size_t>(columns) * sizeof(typename T::Scalar);
      const std::size_t rows = counted(static_cast<std::size_t>(value.rows()), row);
      if constexpr (T::RowsAtCompileTime == Eigen::Dynamic)
        if (reading()) value.resize(static_cast<Eigen::Index>(rows), columns);
      block(value.data(), static_cast<std::size_t>(value.rows()) * row);
    } else if constexpr (requires { value.visit(*this); }) {
      value.visit(*this);
    } else if constexpr (std::is_same_v<T, bool>) {
      truth(value);
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>,
                    "a class with more than plain members needs a visit");
      block(&value, sizeof value);
    }
  }

  void one(std::string& text) {
    text.resize(counted(text.size(), 1));
    block(text.data(), text.size());
  }

  template <class T>
  void one(std::vector<T>& values) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      values.resize(counted(values.size(), sizeof(T)));
      block(values.data(), values.size() * sizeof(T));
    } else {
      values.resize(counted(values.size(), sizeof(std::size_t)));  // that of each piece stands in front of it
      for (T& value : values) one(value);
    }
  }

  template <class T, std::size_t n>
  void one(std::array<T, n>& values) {
    for (T& value : values) one(value);
  }

  template <class T>
  void one(std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (there && !value) value.emplace();
    if (!there) value.reset();
    if (value) one(*value);
  }

  const std::string* source_ = nullptr;
  std::size_t at_ = 0;  ///< read up to here
  std::function<void(std::string_view)> take_;
};

}  // namespace treejet
