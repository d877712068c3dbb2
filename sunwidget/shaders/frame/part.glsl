// Assigns a pixel to a part of its pass: the runner draws each part's shader where the depth is the part's.

void SetPart(int part) {
  gl_FragDepth = 0.25 * float(part + 1);
}
