// Source of the next order, from this order's incident light (bruneton/field.glsl): its mean
// over the phase function of air (upper half) or haze (lower half) around each view direction
// (Bruneton & Neyret 2008, "Delta J", without the densities).

#include "bruneton/field.glsl"

uniform sampler2D incident;
out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  ivec2 tile = texel / field_size.yx;
  ivec2 cell = texel - tile * field_size.yx;
  bool haze = tile.y >= field_size.z;
  float theta = kPi * float(haze ? tile.y - field_size.z : tile.y) / float(field_size.z - 1);
  float phi = acos(GetCosineOfAzimuthSample(float(tile.x), field_size.w));
  float mu = cos(theta);
  float across = sin(theta);
  vec4 sum = vec4(0.0);
  float norm = 0.0;
  for (int zenith = 0; zenith < kFieldZeniths; ++zenith) {
    float mu_i = GetFieldZenithCosine(zenith);
    float across_i = sqrt(1.0 - mu_i * mu_i) * across;
    float weight = GetFieldWeight(zenith);
    for (int azimuth = 0; azimuth < kFieldAzimuths; ++azimuth) {
      // The other half of the circle mirrors this one.
      float phi_i = GetAzimuth(azimuth, kFieldAzimuths);
      float left = mu * mu_i + across_i * cos(phi - phi_i);
      float right = mu * mu_i + across_i * cos(phi + phi_i);
      float phase = haze
          ? MiePhase(aerosol_asymmetry, left) + MiePhase(aerosol_asymmetry, right)
          : RayleighPhase(left) + RayleighPhase(right);
      ivec2 place = ivec2(azimuth, zenith) * field_size.yx + cell;
      sum += weight * phase * texelFetch(incident, place, 0);
      norm += weight * phase;
    }
  }
  // Normalized by its own sum, so that a lobe between two nodes neither adds nor loses light.
  result = sum / norm;
}
