// Which boxes of a row lie within the reach of one box.

HEMOSCALE_LANES std::uint32_t lanes_below(Single v, float limit) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(v), _mm512_set1_ps(limit), _CMP_LT_OQ);
#else
  std::uint32_t mask = 0;
  const auto below = v < limit;
  for (int k = 0; k < Lanes<float>::width; ++k) {
    mask |= (below[k] != 0 ? 1U : 0U) << static_cast<unsigned>(k);
  }
  return mask;
#endif
}

HEMOSCALE_LANES int find_near_boxes(const BoxArguments& g) {
  const Single zero = Single{};
  int found = 0;
  for (int j = 0; j < g.count; j += box_group) {
    Single x0, x1, y0, y1;
    __builtin_memcpy(&x0, g.x0 + j, sizeof x0);
    __builtin_memcpy(&x1, g.x1 + j, sizeof x1);
    __builtin_memcpy(&y0, g.y0 + j, sizeof y0);
    __builtin_memcpy(&y1, g.y1 + j, sizeof y1);
    const Single gap_x = larger(larger(x0 - g.own_x1, g.own_x0 - x1), zero);
    const Single gap_y = larger(larger(y0 - g.own_y1, g.own_y0 - y1), zero);
    std::uint32_t mask = lanes_below(gap_x * gap_x + gap_y * gap_y, g.reach_squared);
    const int left = g.count - j;
    if (left < box_group) mask &= (1U << static_cast<unsigned>(left)) - 1U;
    while (mask != 0) {
      g.hits[found++] = static_cast<std::uint16_t>(j + __builtin_ctz(mask));
      mask &= mask - 1;
    }
  }
  return found;
}
