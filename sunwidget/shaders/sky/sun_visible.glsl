// Whether the photo shows its own sun.

uniform float sun_visible;  // 0 or 1
