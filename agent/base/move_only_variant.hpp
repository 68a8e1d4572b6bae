// A std::variant of texts, lists and numbers that nobody copies.
#pragma once

#include <variant>

namespace gazed::base {

/// libstdc++ 12 takes for granted that a variant of such types always holds one of them, also while
/// it is being copied: a copy that finds no memory destroys a member that was never made, and jumps
/// anywhere (<variant>, _Variant_storage::_M_valid, called of _Copy_ctor_base). Moves allocate
/// nothing.
template <class... Types>
struct MoveOnlyVariant : std::variant<Types...> {
  using std::variant<Types...>::variant;

  MoveOnlyVariant() = default;
  MoveOnlyVariant(MoveOnlyVariant&&) noexcept = default;
  MoveOnlyVariant& operator=(MoveOnlyVariant&&) noexcept = default;
  MoveOnlyVariant(const MoveOnlyVariant&) = delete;
  MoveOnlyVariant& operator=(const MoveOnlyVariant&) = delete;
  ~MoveOnlyVariant() = default;
};

}  // namespace gazed::base
