// The field of all scattered light around a point, as moments (see atmosphere/multiple.glsl): first and
// second order as drawn, the rest as a geometric series of isotropic scattering (Hillaire 2020,
// section 5.5.3).
//
// Hillaire's ratio is f, the share of uniform light that returns after one more scattering at the
// point itself (transfer.glsl). But light spreads from order to order, until all of it decreases by the
// same factor everywhere: the largest eigenvalue of scattering. It is approximated by the geometric
// mean of f and the ratio of second to first order, 3 km up under a high sun: within 8 % in air from
// none to twice ours, over any ground; up to 18 % in the thickest haze. The ratio of the third order to
// the second is the geometric mean of that and the ratio of second to first order at the point.
//
// `scattering_orders` n ends the sum (Nishita et al. 1996): the field holds orders 1 to n - 1, from
// which the sky view makes 2 to n.

#include "atmosphere/multiple.glsl"
#include "atmosphere/moments.glsl"

uniform float scattering_orders;  // 0: all
uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D first_field;
uniform sampler2D second_order;
uniform sampler2D transfer;
out vec4 result;

const float kEigenvalueRow = 6.0 / 19.0;  // of the table: 3 km

// Ratio of the mean of the second order to that of the first.
vec4 GetGain(ivec2 cell, ivec2 size) {
  vec4 second = GetMoment(second_order, kSecondAzimuths, 0, cell, size);
  return min(second / max(texelFetch(first_field, cell, 0), vec4(1e-30)), 1.0);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy + tile_origin);
  ivec2 size = ivec2(pass_size) / ivec2(kMoments, 1);
  int moment = texel.x / size.x;
  ivec2 cell = ivec2(texel.x - moment * size.x, texel.y);
  vec4 even = texelFetch(transfer, ivec2(0, cell.y), 0);
  // The column of `transfer` that holds this moment: mean, z, xx, zz.
  int column = moment == 0 ? 0 : moment - 1;
  bool vanishes = moment == 1 || moment > 4;
  vec4 shape = vanishes ? vec4(0.0) : texelFetch(transfer, ivec2(column, cell.y), 0);
  int row = int(kEigenvalueRow * float(size.y - 1) + 0.5);
  vec4 eigenvalue = sqrt(texelFetch(transfer, ivec2(0, row), 0)
      * GetGain(ivec2(size.x - 1, row), size));
  eigenvalue = min(eigenvalue, 0.95);
  vec4 second_mean = GetMoment(second_order, kSecondAzimuths, 0, cell, size);
  vec4 second = GetMoment(second_order, kSecondAzimuths, moment, cell, size);
  vec4 third_mean = second_mean * sqrt(GetGain(cell, size) * eigenvalue);
  // The share that the series omits after its first n - 3 terms: 0 for the infinite series.
  vec4 omitted = scattering_orders == 0.0 ? vec4(0.0)
      : pow(max(eigenvalue, 1e-9), vec4(max(scattering_orders - 3.0, 0.0)));
  vec4 rest = shape / max(even, 1e-30) * third_mean * (1.0 - omitted) / (1.0 - eigenvalue);
  float drawn = scattering_orders == 2.0 ? 0.0 : 1.0;
  result = texelFetch(first_field, texel, 0) + drawn * second + rest;
}
