"""What the ratchet's FMU holds in every flavour and version of FMI, under the same names."""

_REFERENCE = "extra/org.fmi-standard.fmi-ls-ref"

OF_EVERY_FLAVOUR = {
    "terminalsAndIcons/terminalsAndIcons.xml",
    f"{_REFERENCE}/fmi-ls-manifest.xml",
    f"{_REFERENCE}/Ratchet_ref.csv",
    f"{_REFERENCE}/Ratchet_default.ssv",
    "sources/buildDescription.xml",
    "sources/no_sources.c",
}
