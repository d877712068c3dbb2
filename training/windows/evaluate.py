"""How well the shipped network sees panes: on drawn streets, and on photos that show none.

``python -m training.windows.evaluate --data ../shared/data/train``

Backgrounds and photos are those held out of the training.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from sunwidget.analysis.onnx_file import bundled_session
from sunwidget.analysis.panes import BUNDLED, lamps, probability
from sunwidget.photo import open_photo
from training.windows.data import Batches, held_out, natural


def drawn(photos: list[Path], count: int) -> tuple[float, float, float]:
    """Pooled IoU, precision and recall at one half, on drawn streets."""
    random = np.random.default_rng(20261124)
    batches = Batches(photos, 1, 0)
    session = bundled_session(BUNDLED, "windows")
    both = either = found = true = 0.0
    for _ in range(count):
        image, glass = batches.sample(random)
        picture = (image / np.float32(255)).transpose(2, 0, 1)[None]
        pane = session.run(["pane"], {"image": np.ascontiguousarray(picture)})[0][0, 0] > 0.5
        known = glass > 0.5
        both += (pane & known).sum()
        either += (pane | known).sum()
        found += pane.sum()
        true += known.sum()
    return both / either, both / found, both / true


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--streets", type=int, default=400)
    options = parser.parse_args()
    photos = [p for p in natural(options.data) if held_out(p)]
    overlap, precision, recall = drawn(photos, options.streets)
    print(f"drawn streets: IoU {overlap:.3f}, precision {precision:.3f}, recall {recall:.3f}")
    lit = np.array([(lamps(probability(open_photo(p)))[..., 0] > 0).mean() for p in photos])
    print(
        f"{lit.size} photos of nature: {(lit > 0).sum()} with a lit place, "
        f"{(lit > 0.001).sum()} with more than a thousandth, {lit.mean():.5%} of all pixels"
    )
    for share, path in sorted(zip(lit, photos, strict=True), reverse=True)[:12]:
        print(f"  {share:.3%}  {path.name}")


if __name__ == "__main__":
    main()
