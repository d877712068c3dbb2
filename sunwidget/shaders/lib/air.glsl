// The air before distant land (aerial perspective), by the strips that air.glsl draws.

uniform sampler2D air_source;
uniform sampler2D air_edit;
uniform float aerial_perspective;

// What the air adds to relit land when the sun moves. `gain` is the land's own ratio, `depth` in
// metres; Koschmieder 1924: I = J t + A (1 - t), so that J g t + A' (1 - t) is I g + (A' - A g)(1 - t).
vec3 GetAirChange(vec2 place, float log_depth, vec3 gain) {
  return vec3(0.0);
}
