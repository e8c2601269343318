#!/bin/sh
# Copies one of OpenFOAM's own tutorials, unchanged, into a new folder; compressed files are unpacked.
#
#   openfoam-tutorial.sh NAME FOLDER        for instance incompressible/nonNewtonianIcoFoam/offsetCylinder
#
# Taken from a sourced OpenFOAM ($FOAM_TUTORIALS), from Debian's package openfoam-examples, or, where
# that package is installed without its documentation (slim images leave /usr/share/doc out) or not
# at all, from its archive, which is downloaded for the purpose (no rights of root needed).
set -eu

fail() { printf 'openfoam-tutorial: error: %s\n' "$*" >&2; exit 1; }
[ $# -eq 2 ] || fail 'usage: openfoam-tutorial.sh NAME FOLDER'
name=$1
target=$2
packaged=usr/share/doc/openfoam-examples/examples
[ ! -e "$target" ] || fail "$target exists; remove it or name another folder"

work=
clean() { [ -z "$work" ] || rm -rf "$work"; }
trap clean EXIT
trap 'exit 130' INT TERM

source=
for folder in "${FOAM_TUTORIALS:-/nonexistent}" "/$packaged"; do
  if [ -d "$folder/$name" ]; then source=$folder/$name; break; fi
done
if [ -z "$source" ]; then
  command -v apt-get >/dev/null && command -v dpkg >/dev/null ||
    fail "no tutorial $name: set FOAM_TUTORIALS to the tutorials of an OpenFOAM installation"
  echo 'openfoam-tutorial: downloading the package openfoam-examples'
  work=$(mktemp -d)
  (cd "$work" && apt-get download openfoam-examples >apt.log 2>&1 && dpkg -x openfoam-examples_*.deb tree) ||
    { cat "$work/apt.log" >&2; fail 'openfoam-examples cannot be downloaded; is the list of packages there (apt-get update)?'; }
  source=$work/tree/$packaged/$name
  [ -d "$source" ] || fail "openfoam-examples has no tutorial $name"
fi

mkdir -p "$(dirname -- "$target")"
cp -r "$source" "$target"
chmod -R u+w "$target"
find "$target" -type f -name '*.gz' -exec gunzip {} +
