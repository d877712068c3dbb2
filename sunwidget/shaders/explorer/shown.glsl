// The views of one or two models with the shown orders of scattering, texel by texel: all have the
// same layout (atmosphere/read_sky_view.glsl) and are divided by the same guess, so that they add up.
// Views that a run does not draw are bound to `sky_view` and not used.
//
// The reference is a picture, not a view. For it this holds the remainder: the shown sky is
// show_multiple times the reference plus this.

uniform vec2 pass_size;
uniform sampler2D sky_view;         // all orders, or as many as are set
uniform sampler2D sky_view_single;  // the first order alone
uniform sampler2D bruneton_view;
uniform float model;                // 0 multiple, 1 single, 2 bruneton, 3 reference
uniform float compare;              // 0 none, else 1 + a model
uniform float show_single;          // 0 or 1
uniform float show_multiple;
out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  int columns = int(pass_size.x) / 2;
  bool right = texel.x >= columns;
  texel.x -= right ? columns : 0;
  vec4 all_orders = texelFetch(sky_view, texel, 0);
  if (texel.y == int(pass_size.y) - 1) {
    result = all_orders;  // the description
    return;
  }
  float chosen = right && compare > 0.5 ? compare - 1.0 : model;
  vec4 single = texelFetch(sky_view_single, texel, 0);
  vec4 bruneton = texelFetch(bruneton_view, texel, 0);
  // Single scattering is the same light in every model.
  vec4 whole = chosen < 0.5 ? all_orders : chosen < 1.5 ? single : bruneton;
  bool every = show_single * show_multiple > 0.5;
  vec4 part = show_multiple * max(whole - single, 0.0) + show_single * single;
  result = chosen > 2.5 ? (show_single - show_multiple) * single : every ? whole : part;
}
