"""The edit in XMP: recorded, read back, and nothing of the photo's own packet lost."""

import pytest

from sunwidget.edit.table import Edit
from sunwidget.formats import xmp

OWN = b"""<?xpacket begin="\xef\xbb\xbf" id="W5M0MpCehiHzreSzNTczkc9d"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/" x:xmptk="XMP Core 6.0">
 <rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
  <rdf:Description rdf:about="uuid:1" xmlns:xmp="http://ns.adobe.com/xap/1.0/"
    xmlns:xmpMM="http://ns.adobe.com/xap/1.0/mm/"
    xmlns:stEvt="http://ns.adobe.com/xap/1.0/sType/ResourceEvent#"
    xmlns:dc="http://purl.org/dc/elements/1.1/"
    xmp:CreatorTool="Darkroom 3" xmp:Rating="4">
   <dc:subject><rdf:Bag><rdf:li>sea &amp; sun</rdf:li></rdf:Bag></dc:subject>
   <xmpMM:History><rdf:Seq><rdf:li stEvt:action="derived"/></rdf:Seq></xmpMM:History>
  </rdf:Description>
 </rdf:RDF>
</x:xmpmeta>
<?xpacket end="w"?>"""
RECIPE = Edit(sun_elevation=3.5, sun_azimuth=-4).to_dict()


def properties(packet):
    """Every attribute and text of a packet, by Pillow's own reader."""
    from PIL import Image

    image = Image.new("RGB", (1, 1))
    image.info["xmp"] = packet
    return str(image.getxmp())


@pytest.mark.parametrize("own", [None, OWN])
def test_a_recipe_comes_back(own):
    packet = xmp.record(own, RECIPE, "sunwidget 1")
    assert xmp.recipe(packet) == RECIPE
    assert packet == xmp.record(own, RECIPE, "sunwidget 1")  # no clock in it


def test_the_photos_own_packet_is_kept():
    found = properties(xmp.record(OWN, RECIPE, "sunwidget 1", before="Firmware 2"))
    for kept in ("sea & sun", "Darkroom 3", "'Rating': '4'", "'action': 'derived'"):
        assert kept in found
    assert "Firmware 2" not in found
    assert found.index("derived") < found.index("'softwareAgent': 'sunwidget 1'")


def test_the_first_program_is_named_where_nobody_did():
    assert "'CreatorTool': 'Firmware 2'" in properties(
        xmp.record(None, RECIPE, "sunwidget 1", before="Firmware 2")
    )
    assert "'CreatorTool': 'sunwidget 1'" in properties(xmp.record(None, RECIPE, "sunwidget 1"))


def test_a_second_edit_replaces_the_recipe_and_continues_the_history():
    once = xmp.record(OWN, RECIPE, "sunwidget 1")
    twice = xmp.record(once, Edit(exposure=1).to_dict(), "sunwidget 2")
    assert Edit.from_dict(xmp.recipe(twice)) == Edit(exposure=1)
    assert twice.count(b"sunwidget:recipe=") == 1
    found = properties(twice)
    assert found.index("'sunwidget 1'") < found.index("'sunwidget 2'")


def test_a_recipe_too_long_for_a_jpeg_is_left_to_the_exif():
    packet = xmp.record(None, {"strokes": "x" * 40_000}, "sunwidget 1")
    assert xmp.recipe(packet) is None
    assert len(packet) < 2000


@pytest.mark.parametrize(
    "packet",
    [
        b"garbage",
        b"<a/>",
        b"\xff\xfe\x00",
        OWN.replace(b"<x:xmpmeta", b'<!DOCTYPE a [<!ENTITY b "c">]><x:xmpmeta', 1),
        b"<a>" * 3000 + b"</a>" * 3000,
        OWN[:-300],
    ],
)
def test_a_packet_that_is_no_xmp_stays_as_it_is(packet):
    assert xmp.record(packet, RECIPE, "sunwidget 1") == packet
    assert xmp.recipe(packet) is None


@pytest.mark.parametrize("text", ["3", "[]", "{", "&quot;", ""])
def test_a_recipe_that_is_none_is_none(text):
    packet = xmp.record(None, RECIPE, "sunwidget 1").decode()
    start = packet.index('sunwidget:recipe="') + len('sunwidget:recipe="')
    packet = packet[:start] + text + packet[packet.index('"', start) :]
    assert xmp.recipe(packet.encode()) is None
