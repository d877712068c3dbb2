"""XMP packets: write and read an edit's recipe; everything else in the packet stays.

Adobe, "XMP Specification Part 1" (2012) and Part 2, 2.2 (xmpMM:History). No time is written, so
that the same edit of the same photo gives the same file.
"""

from __future__ import annotations

import json
import re
from typing import Any
from xml.dom import minidom

_RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
_XMP = "http://ns.adobe.com/xap/1.0/"
_HISTORY = "http://ns.adobe.com/xap/1.0/mm/"
_EVENT = "http://ns.adobe.com/xap/1.0/sType/ResourceEvent#"
_OWN = "urn:sunwidget:edit:1:"
_GAIN_MAP = "http://ns.adobe.com/hdr-gain-map/1.0/"
_CONTAINER = "http://ns.google.com/photos/1.0/container/"
_ITEM = "http://ns.google.com/photos/1.0/container/item/"
_EMPTY = f'<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="{_RDF}"/></x:xmpmeta>'
# A longer recipe (thousands of stroke points) goes into the EXIF only: a JPEG segment holds 64 kB.
_LONGEST_RECIPE = 32_000


def record(
    packet: bytes | None, recipe: dict[str, Any], software: str, *, before: str = ""
) -> bytes | None:
    """Return ``packet`` with an edit recorded.

    Parameters
    ----------
    packet : bytes or None
        The photo's own XMP; all of it is kept. A packet that is not XML is returned unchanged.
    recipe : dict
        ``Edit.to_dict()``, stored as JSON in sunwidget's namespace.
    software : str
        Program and version, for the history.
    before : str
        Program that made the photo, for ``xmp:CreatorTool`` if the packet does not name it.
    """
    try:
        document = _parsed(packet or _EMPTY.encode())
        rdf = document.getElementsByTagNameNS(_RDF, "RDF")[0]
        _remove_recipe(rdf)
        tool = "".join(c for c in before if c.isprintable())  # XML allows no control characters
        _add_recipe(document, rdf, recipe, tool or software)
        _continue_history(document, rdf, software)
        return _serialize(document)
    except (_NotXmpError, IndexError, RecursionError):
        return packet


def recipe(packet: bytes | None) -> dict[str, Any] | None:
    """Return the recipe that :func:`record` wrote, or None."""
    if not packet or _OWN.encode() not in packet:
        return None
    try:
        for description in _descriptions(_parsed(packet)):
            text = description.getAttributeNS(_OWN, "recipe")
            found = json.loads(text) if text else None
            if isinstance(found, dict):
                return found
    except (_NotXmpError, ValueError, RecursionError):
        pass
    return None


def upright(packet: bytes | None) -> bytes | None:
    """Return the packet of a picture that was turned upright; None for an empty one."""
    if not packet:
        return None
    return re.sub(rb"""(tiff:Orientation(?:>|=["']))\d""", rb"\g<1>1", packet)


def gain_map_packet(metadata: dict[str, list[float]]) -> bytes:
    """Return the packet of a gain map's own JPEG; each name has one number or one by channel."""
    single = {name: values[0] for name, values in metadata.items() if len(values) == 1}
    attributes = "".join(f' hdrgm:{name}="{value:.9g}"' for name, value in single.items())
    lists = "".join(
        f"<hdrgm:{name}><rdf:Seq>"
        + "".join(f"<rdf:li>{value:.9g}</rdf:li>" for value in values)
        + f"</rdf:Seq></hdrgm:{name}>"
        for name, values in metadata.items()
        if len(values) > 1
    )
    return (
        f'<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="{_RDF}">'
        f'<rdf:Description rdf:about="" xmlns:hdrgm="{_GAIN_MAP}" hdrgm:Version="1.0"'
        f' hdrgm:BaseRenditionIsHDR="False"{attributes}>{lists}</rdf:Description>'
        "</rdf:RDF></x:xmpmeta>"
    ).encode()


def gain_map_values(packet: bytes | None) -> dict[str, list[float]] | None:
    """Return the numbers of a gain map's packet by name; None if it is not a map's packet.

    Raises
    ------
    ValueError
        For values that are not numbers.
    """
    if not packet or _GAIN_MAP.encode() not in packet:
        return None
    found: dict[str, list[float]] = {}
    try:
        for description in _descriptions(_parsed(packet)):
            for attribute in description.attributes.values():
                if attribute.namespaceURI == _GAIN_MAP:
                    found[attribute.localName] = _numbers(attribute.value)
            for child in description.childNodes:
                if child.namespaceURI == _GAIN_MAP:
                    rows = child.getElementsByTagNameNS(_RDF, "li") or [child]
                    found[child.localName] = [x for row in rows for x in _numbers(_text(row))]
    except (_NotXmpError, RecursionError):
        return None
    # The picture's own packet has the version only; the map's packet has the numbers.
    return found if "GainMapMax" in found and found.get("BaseRenditionIsHDR") != [1.0] else None


def with_gain_map(packet: bytes | None, length: int) -> bytes:
    """Return the packet of a picture that its gain map of ``length`` bytes follows in the file."""
    try:
        document = _parsed(without_gain_map(packet) or _EMPTY.encode())
        rdf = document.getElementsByTagNameNS(_RDF, "RDF")[0]
    except (_NotXmpError, IndexError):
        document = _parsed(_EMPTY.encode())
        rdf = document.getElementsByTagNameNS(_RDF, "RDF")[0]
    prefix = _prefix(rdf)
    rows = "".join(
        f'<{prefix}:li {prefix}:parseType="Resource">'
        f'<Container:Item Item:Mime="image/jpeg" {more}/></{prefix}:li>'
        for more in ('Item:Semantic="Primary"', f'Item:Semantic="GainMap" Item:Length="{length}"')
    )
    addition = _parsed(
        f'<{prefix}:Description xmlns:{prefix}="{_RDF}" xmlns:hdrgm="{_GAIN_MAP}"'
        f' xmlns:Container="{_CONTAINER}" xmlns:Item="{_ITEM}" {prefix}:about=""'
        f' hdrgm:Version="1.0"><Container:Directory><{prefix}:Seq>{rows}</{prefix}:Seq>'
        f"</Container:Directory></{prefix}:Description>".encode()
    ).documentElement
    assert addition is not None
    addition.setAttributeNS(_RDF, f"{prefix}:about", _about(rdf))
    rdf.appendChild(document.importNode(addition, deep=True))
    return _serialize(document)


def without_gain_map(packet: bytes | None) -> bytes | None:
    """Return a packet without references to a gain map or to other pictures in its file."""
    if not packet or not any(name.encode() in packet for name in (_GAIN_MAP, _CONTAINER)):
        return packet
    try:
        document = _parsed(packet)
        for description in _descriptions(document):
            for attribute in list(description.attributes.values()):
                if _GAIN_MAP in (attribute.namespaceURI, attribute.value):
                    description.removeAttributeNode(attribute)
            for child in list(description.childNodes):
                if child.namespaceURI in (_GAIN_MAP, _CONTAINER):
                    description.removeChild(child)
        return _serialize(document)
    except (_NotXmpError, RecursionError):
        return packet


def _numbers(text: str) -> list[float]:
    """Return the numbers in a text; True and False become 1 and 0."""
    words = {"True": "1", "False": "0"}
    return [float(words.get(part, part)) for part in text.replace(",", " ").split()]


def _text(node: Any) -> str:
    return "".join(child.data for child in node.childNodes if child.nodeType == child.TEXT_NODE)


def _serialize(document: minidom.Document) -> bytes:
    body = document.documentElement.toxml() if document.documentElement else ""
    begin = '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?>'
    return f'{begin}\n{body}\n<?xpacket end="w"?>'.encode()


class _NotXmpError(Exception):
    """The packet is not XML, or contains declarations that are refused."""


def _parsed(packet: bytes) -> minidom.Document:
    # Entity declarations, which could expand a small packet to a huge one, do not belong in XMP.
    if re.search(rb"<!(DOCTYPE|ENTITY)", packet, re.IGNORECASE) or b"\0" in packet.rstrip(b"\0"):
        raise _NotXmpError
    try:
        return minidom.parseString(packet.strip(b"\0 \t\r\n"))  # noqa: S318 - see above
    except Exception as error:  # expat and minidom fail in many ways on untrusted text
        raise _NotXmpError from error


def _descriptions(node: minidom.Document | minidom.Element) -> list[minidom.Element]:
    return list(node.getElementsByTagNameNS(_RDF, "Description"))


def _remove_recipe(rdf: minidom.Element) -> None:
    """Remove the recipe of an earlier edit."""
    for description in _descriptions(rdf):
        for attribute in list(description.attributes.values()):
            if _OWN in (attribute.namespaceURI, attribute.value):
                description.removeAttributeNode(attribute)
        others = [a for a in description.attributes.values() if a.localName != "about"]
        if not others and not description.childNodes and description.parentNode:
            description.parentNode.removeChild(description)


def _add_recipe(
    document: minidom.Document, rdf: minidom.Element, recipe: dict[str, Any], tool: str
) -> None:
    own = document.createElementNS(_RDF, f"{_prefix(rdf)}:Description")
    own.setAttributeNS(_RDF, f"{_prefix(rdf)}:about", _about(rdf))
    text = json.dumps(recipe)
    if len(text) <= _LONGEST_RECIPE:
        own.setAttribute("xmlns:sunwidget", _OWN)
        own.setAttributeNS(_OWN, "sunwidget:recipe", text)
    if not _has(rdf, _XMP, "CreatorTool"):
        own.setAttribute("xmlns:xmp", _XMP)
        own.setAttributeNS(_XMP, "xmp:CreatorTool", tool)
    rdf.appendChild(own)


def _continue_history(document: minidom.Document, rdf: minidom.Element, software: str) -> None:
    prefix = _prefix(rdf)
    rows = [
        row
        for history in rdf.getElementsByTagNameNS(_HISTORY, "History")
        for row in history.getElementsByTagNameNS(_RDF, "Seq")
    ]
    if rows:
        row = rows[0]
    else:
        history = document.createElementNS(_HISTORY, "xmpMM:History")
        history.setAttribute("xmlns:xmpMM", _HISTORY)
        row = document.createElementNS(_RDF, f"{prefix}:Seq")
        history.appendChild(row)
        _descriptions(rdf)[-1].appendChild(history)
    event = document.createElementNS(_RDF, f"{prefix}:li")
    event.setAttribute("xmlns:stEvt", _EVENT)
    for name, value in (
        ("action", "edited"),
        ("softwareAgent", software),
        ("parameters", "sun moved; recipe in sunwidget:recipe"),
    ):
        event.setAttributeNS(_EVENT, f"stEvt:{name}", value)
    row.appendChild(event)


def _prefix(rdf: minidom.Element) -> str:
    return rdf.prefix or "rdf"


def _about(rdf: minidom.Element) -> str:
    """Return the packet's ``rdf:about``, which must be the same in all descriptions."""
    return next((d.getAttributeNS(_RDF, "about") for d in _descriptions(rdf)), "")


def _has(rdf: minidom.Element, namespace: str, name: str) -> bool:
    return bool(rdf.getElementsByTagNameNS(namespace, name)) or any(
        d.hasAttributeNS(namespace, name) for d in _descriptions(rdf)
    )
