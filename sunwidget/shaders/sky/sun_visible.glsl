// What is known of the photo's own sun.

uniform float sun_visible;  // 0 or 1
uniform float sun_located;  // whether it shows its sun or moon, 0 or 1
uniform float sun_known;  // whether the photo or the user tells where it is, 0 or 1

// The light of a sun that is only assumed is believed by this share.
const float kAssumed = 0.5;

float GetBelief() {
  return mix(kAssumed, 1.0, sun_known);
}
