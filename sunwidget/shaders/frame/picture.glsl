// Viewing directions of pixels, and reading of scene textures.
// Picture coordinates: fractions of width and height, (0,0) at the top left corner.
// World coordinates: x to the right of the camera's heading, y up, z along the heading.

#include "frame/frame_size.glsl"

uniform vec3 camera_right;    // world axes in camera coordinates (x right, y down, z forward)
uniform vec3 camera_up;
uniform vec3 camera_forward;
uniform float camera_focal;   // focal length in units of the picture's height

vec3 GetViewDirection(vec2 place) {
  float aspect = frame_size.x / frame_size.y;
  vec3 ray = normalize(vec3((place.x - 0.5) * aspect / camera_focal, (place.y - 0.5) / camera_focal, 1.0));
  return vec3(dot(ray, camera_right), dot(ray, camera_up), dot(ray, camera_forward));
}

// The inverse: the place where a direction appears. z of the result is positive in front of the camera.
vec3 GetPlaceOfDirection(vec3 direction) {
  float aspect = frame_size.x / frame_size.y;
  vec3 ray = direction.x * camera_right + direction.y * camera_up + direction.z * camera_forward;
  float depth = max(abs(ray.z), 1e-4);
  return vec3(0.5 + ray.x / depth * camera_focal / aspect, 0.5 + ray.y / depth * camera_focal, ray.z);
}

// Bilinear, clamped at the edge. Computed by hand: without filter state both hosts agree.
vec4 ReadBilinear(sampler2D image, vec2 place) {
  vec2 size = vec2(textureSize(image, 0));
  vec2 at = clamp(place * size - 0.5, vec2(0.0), size - 1.0);
  ivec2 low = ivec2(floor(at));
  ivec2 high = min(low + 1, ivec2(size) - 1);
  vec2 share = at - vec2(low);
  vec4 top = mix(texelFetch(image, low, 0), texelFetch(image, ivec2(high.x, low.y), 0), share.x);
  vec4 bottom = mix(texelFetch(image, ivec2(low.x, high.y), 0), texelFetch(image, high, 0), share.x);
  return mix(top, bottom, share.y);
}

// Nearest texel, for textures of at least the picture's size: exact if the sizes agree.
vec4 ReadPicture(sampler2D image, vec2 place) {
  ivec2 size = textureSize(image, 0);
  return texelFetch(image, clamp(ivec2(place * vec2(size)), ivec2(0), size - 1), 0);
}
