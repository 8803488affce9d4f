#!/usr/bin/env bash
# Real files for tests/import/coverage.sh, into the ignored folder tests/import/real. Needs npm, pip and dpkg-deb; licences: docs/import.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
mkdir -p real
cd real

if [ ! -d feather ]; then
    npm pack --silent feather-icons@4.29.2 >/dev/null
    tar xzf feather-icons-4.29.2.tgz package/dist/icons package/LICENSE
    mv package feather
fi
if [ ! -d simple-icons ]; then
    npm pack --silent simple-icons@13.21.0 >/dev/null
    tar xzf simple-icons-13.21.0.tgz package/icons package/LICENSE.md
    mv package simple-icons
fi
if [ ! -d font ]; then
    pip download --quiet --no-deps --only-binary :all: --platform manylinux2014_x86_64 --python-version 3.11 matplotlib==3.9.4
    mkdir font
    python3 -m zipfile -e matplotlib-3.9.4-*.whl unpacked
    cp unpacked/matplotlib/mpl-data/fonts/ttf/DejaVuSans.ttf unpacked/matplotlib/mpl-data/fonts/ttf/LICENSE_DEJAVU font
    rm -r unpacked
fi
if [ ! -d iges ]; then
    pip download --quiet --no-deps --only-binary :all: pyiges==0.3.4
    python3 -m zipfile -e pyiges-0.3.4-*.whl iges
fi
if [ ! -d protein ]; then
    # The archive alone: pip would build it.
    url=$(python3 -c 'import json, urllib.request
project = json.load(urllib.request.urlopen("https://pypi.org/pypi/gemmi/json"))
files = project.get("releases", {}).get("0.7.5") or project["urls"]
print(next(file["url"] for file in files if file["packagetype"] == "sdist"))')
    curl --silent --show-error --location --output gemmi.tar.gz "$url"
    mkdir protein
    tar xzf gemmi.tar.gz --strip 2 -C protein --wildcards 'gemmi-*/tests/1lzh.pdb.gz' 'gemmi-*/tests/5i55.cif'
    gunzip protein/1lzh.pdb.gz
fi
if [ ! -d step ]; then
    apt-get download -q gmsh-doc
    dpkg-deb -x gmsh-doc_*.deb unpacked
    mkdir step
    find unpacked -path '*demos/boolean*' -name '*.st*p.gz' -exec cp {} step \;
    gunzip step/*.gz
    rm -r unpacked
fi
