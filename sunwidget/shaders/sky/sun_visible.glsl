// What the photo shows of its own sun.

uniform float sun_visible;  // 0 or 1
uniform float sun_located;  // whether it shows its sun or the glow of a hidden one, 0 or 1
