#pragma once
/// A register of W numbers, in the compiler's vector extensions: + - * / and comparisons work lane by lane, a
/// scalar operand is broadcast. Included only by the units of kernels.hpp; no function here may have
/// external linkage (the anonymous namespace sees to it), so nothing of the standard library is called but
/// builtins.

namespace treejet {
namespace {

template <class T, int W>
struct WideOf {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};
template <class T, int W>
using Wide = typename WideOf<T, W>::type;

/// The W numbers at p, any alignment.
template <class T, int W>
inline Wide<T, W> load(const T* p) {
  Wide<T, W> v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

/// The first `count` numbers at p; zeros in the other lanes.
template <class T, int W>
inline Wide<T, W> load_first(const T* p, int count) {
  if (count >= W) return load<T, W>(p);
  Wide<T, W> v{};
  for (int k = 0; k < count; ++k) v[k] = p[k];
  return v;
}

/// Lanes first <= k < last of v to p[k].
template <class T, int W>
inline void store_lanes(T* p, Wide<T, W> v, int first, int last) {
  if (first <= 0 && last >= W) {
    __builtin_memcpy(p, &v, sizeof v);
  } else {
    for (int k = first < 0 ? 0 : first; k < last && k < W; ++k) p[k] = v[k];
  }
}

/// first, first + 1, first + 2, ..., in integers as long as a T, so that they compare to registers of T.
template <class T, int W>
inline auto count_from(int first) {
  using Integer = decltype(Wide<T, W>{} < Wide<T, W>{});
  Integer v{};
  for (int k = 0; k < W; ++k) v[k] = first + k;
  return v;
}

}  // namespace
}  // namespace treejet
