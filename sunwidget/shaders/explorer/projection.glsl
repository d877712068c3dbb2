// Three projections from a pixel to its direction. Twins: sunwidget/explorer/projection.py and
// js/src/explorer/projection.js.
//
//   0  dome      equidistant fisheye of the upper half of the sky, zenith in the middle, the
//                azimuth `view_azimuth` at the top. The view is upwards, so east lies to the left of
//                north. The dome's diameter is kDomeShare of the smaller side: room for labels.
//   1  panorama  equirectangular, all azimuths around `view_azimuth`, elevations from -10 to 90
//                degrees, as large as fits
//   2  camera    perspective towards `view_azimuth` and `view_elevation`, `fov` degrees high
//
// Directions are unit vectors: x towards azimuth 90, y up, z towards azimuth 0; azimuths grow
// clockwise. A pixel's center is at half integers, the origin is the top left corner.

#include "frame/frame_size.glsl"

uniform float projection;      // 0, 1, 2 as above
uniform float view_azimuth;    // degrees
uniform float view_elevation;  // degrees
uniform float fov;             // degrees, vertical

const float kDomeShare = 0.94;
const float kPanoramaBottom = -10.0;  // degrees of elevation
const float kPanoramaHeight = 100.0;

vec3 GetDirectionAt(float azimuth, float elevation) {
  float level = cos(elevation);
  return vec3(level * sin(azimuth), sin(elevation), level * cos(azimuth));
}

// Pixels from the zenith to the horizon.
float GetDomeRadius() {
  return 0.5 * kDomeShare * min(frame_size.x, frame_size.y);
}

// Pixels per degree.
float GetPanoramaScale() {
  return min(frame_size.x / 360.0, frame_size.y / kPanoramaHeight);
}

// Focal length in pixels.
float GetCameraFocal() {
  return 0.5 * frame_size.y / tan(0.5 * radians(fov));
}

// Angle of one pixel, radians.
float GetPixelAngle() {
  return projection < 0.5 ? radians(90.0) / GetDomeRadius()
      : projection < 1.5 ? radians(1.0) / GetPanoramaScale()
      : 1.0 / GetCameraFocal();
}

// The share of a pixel that shows sky: the dome's rim is soft.
float GetCoverage(vec2 pixel) {
  vec2 at = abs(pixel - 0.5 * frame_size);
  if (projection < 0.5) return clamp(GetDomeRadius() - length(at) + 0.5, 0.0, 1.0);
  vec2 half_size = 0.5 * GetPanoramaScale() * vec2(360.0, kPanoramaHeight);
  return projection < 1.5 ? step(at.x, half_size.x) * step(at.y, half_size.y) : 1.0;
}

// Sets the direction that `pixel` shows; returns false if it shows no sky.
bool GetViewDirection(vec2 pixel, out vec3 direction) {
  vec2 at = pixel - 0.5 * frame_size;
  float heading = radians(view_azimuth);
  if (projection < 0.5) {
    float from_zenith = min(length(at) / GetDomeRadius(), 1.0);
    float turn = from_zenith > 0.0 ? atan(-at.x, -at.y) : 0.0;
    direction = GetDirectionAt(heading + turn, radians(90.0) * (1.0 - from_zenith));
  } else if (projection < 1.5) {
    vec2 angles = vec2(at.x, -at.y) / GetPanoramaScale();
    float middle = kPanoramaBottom + 0.5 * kPanoramaHeight;
    direction = GetDirectionAt(heading + radians(angles.x), radians(middle + angles.y));
  } else {
    float rise = radians(view_elevation);
    vec3 forward = GetDirectionAt(heading, rise);
    vec3 right = vec3(cos(heading), 0.0, -sin(heading));
    vec3 up = GetDirectionAt(heading, rise + radians(90.0));
    direction = normalize(GetCameraFocal() * forward + at.x * right - at.y * up);
  }
  return GetCoverage(pixel) > 0.0;
}
