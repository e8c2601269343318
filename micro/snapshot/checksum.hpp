#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hemoscale::micro {

/// FNV-1a, 64 bits (Fowler, Noll and Vo; RFC 9923): for every byte, hash = (hash xor byte) * prime.
/// Both operations are one-to-one in the hash, so that a change of one byte always changes the
/// result. It guards against damage, not against intent.
std::uint64_t checksum(std::string_view bytes);

/// Sixteen lower-case hexadecimal digits.
std::string to_hexadecimal(std::uint64_t value);

}  // namespace hemoscale::micro
