// Which of a pass's parts a pixel belongs to: the runner draws each part's shader where this depth is.

void SetPart(int part) {
  gl_FragDepth = 0.25 * float(part + 1);
}
