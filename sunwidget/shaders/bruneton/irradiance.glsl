// Irradiance of one order of scattered light on level ground, over mu_s: the incident light of
// the lowest altitude, times the cosine (Bruneton & Neyret 2008, "Delta E").

#include "bruneton/field.glsl"

uniform sampler2D incident;
out vec4 result;

void main() {
  int sun = int(gl_FragCoord.x);
  vec4 sum = vec4(0.0);
  for (int zenith = 0; zenith < kFieldZeniths / 2; ++zenith) {
    float weight = GetFieldWeight(zenith) * GetFieldZenithCosine(zenith);
    for (int azimuth = 0; azimuth < kFieldAzimuths; ++azimuth) {
      ivec2 place = ivec2(azimuth, zenith) * field_size.yx + ivec2(sun, 0);
      sum += weight * texelFetch(incident, place, 0);
    }
  }
  result = 4.0 * kPi * sum;
}
