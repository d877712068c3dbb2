// From which height on a sun reaches a place on land, for eight bearings from the camera's heading clockwise, as the
// photo lets expect (analysis/relief.py): 1.5 x - 0.25 is the sine. Bearings 0 to 3 lie above 4 to 7.

uniform sampler2D rise;

const float kSoftRise = 0.08;  // sines over which a sun rises there
// By so much less than expected: of open ground too, and under a low sun the march of shadow.glsl sees what is long.
const float kOpen = 0.2;

vec4 ReadBearings(vec2 place, int half_of) {
  ivec2 size = textureSize(rise, 0) / ivec2(1, 2);
  vec2 at = clamp(place * vec2(size) - 0.5, vec2(0.0), vec2(size) - 1.0);
  ivec2 low = ivec2(floor(at));
  ivec2 high = min(low + 1, size - 1);
  vec2 share = at - vec2(low);
  ivec2 first = ivec2(0, half_of * size.y);
  vec4 top = mix(texelFetch(rise, first + low, 0), texelFetch(rise, first + ivec2(high.x, low.y), 0), share.x);
  vec4 bottom = mix(texelFetch(rise, first + ivec2(low.x, high.y), 0), texelFetch(rise, first + high, 0), share.x);
  return 1.5 * mix(top, bottom, share.y) - 0.25;
}

// How much of a sun in this direction, in world coordinates, may be expected to reach the place.
float GetExpectedSun(vec2 place, vec3 sun) {
  float bearing = mod(4.0 / 3.14159265 * atan(sun.x, sun.z), 8.0);
  vec4 first = abs(mod(bearing - vec4(0.0, 1.0, 2.0, 3.0) + 4.0, 8.0) - 4.0);
  vec4 second = abs(mod(bearing - vec4(4.0, 5.0, 6.0, 7.0) + 4.0, 8.0) - 4.0);
  float height = dot(max(1.0 - first, 0.0), ReadBearings(place, 0)) + dot(max(1.0 - second, 0.0), ReadBearings(place, 1));
  // The lowest code says that nothing is expected.
  float hidden = 1.0 - 1.0 / (1.0 + exp((height - kOpen - sun.y) / kSoftRise));
  return 1.0 - hidden * smoothstep(-0.25, -0.2, height);  // the lowest code says that nothing is expected
}
