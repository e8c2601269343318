#!/bin/sh
# Fetches the headers that belong to the installed OpenFOAM package of Debian.
#
#   openfoam-headers.sh [FOLDER]
#
# Debian ships OpenFOAM's libraries and solvers, but not its headers; they are in the source package
# of the same version. This script downloads that source package (45 MB) and unpacks the few folders
# that the plug-in compiles against (37 MB) into FOLDER, by default $HEMOSCALE_OPENFOAM_SOURCE or
# build/openfoam-source beside the sources of HemoScale.
#
# The source entry is derived from the machine's own apt sources (types deb to deb-src), so the
# download comes from the same mirror, with the same keys, as the packages. The lists are kept in a
# private folder: nothing of the system's apt is changed, and no rights of root are needed. Apt checks
# the signature and the checksum. Safe to repeat: what is present is not fetched again.
set -eu

say() { printf 'openfoam-headers: %s\n' "$*"; }
fail() { printf 'openfoam-headers: error: %s\n' "$*" >&2; exit 1; }

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
target=${1:-${HEMOSCALE_OPENFOAM_SOURCE:-$root/build/openfoam-source}}
parts='src/OpenFOAM src/OSspecific/POSIX src/finiteVolume src/meshTools src/fileFormats src/surfMesh
       src/transportModels src/TurbulenceModels/turbulenceModels src/TurbulenceModels/incompressible META-INFO'

command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
  fail 'this is not a Debian system (no dpkg-query or apt-get); source an OpenFOAM installation instead: it has its headers'
version=$(dpkg-query -W -f '${source:Version}' libopenfoam 2>/dev/null) && [ -n "$version" ] ||
  fail 'the package libopenfoam is not installed; install it first: apt-get install --no-install-recommends openfoam'

stamp=$target/.hemoscale-headers
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$version" ] && [ -f "$target/src/OpenFOAM/db/Time/Time.H" ]; then
  say "the headers of $version are in $target already"
  exit 0
fi
if [ -e "$target" ] && [ ! -f "$stamp" ] && [ -n "$(ls -A "$target" 2>/dev/null)" ]; then
  fail "$target exists and was not made by this script; name another folder or remove it"
fi
for tool in tar bzip2 xz; do
  command -v $tool >/dev/null || fail "'$tool' is missing; install it: apt-get install --no-install-recommends tar bzip2 xz-utils"
done

mkdir -p "$(dirname -- "$target")" || fail "cannot make the folder of $target"
work=$(mktemp -d "$target.XXXXXX") || fail "cannot write beside $target"
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/parts" "$work/download"

# The system's entries as source entries. One-line format: first word; deb822: the field Types.
# `wanted` holds the addresses that provide the installed package; when apt does not know them (its
# lists are empty) every entry is used.
wanted=$(apt-cache madison libopenfoam 2>/dev/null | awk -F'|' '{ split($3, a, " "); sub("/+$", "", a[1]); print a[1] }' | sort -u)
one_line() {
  awk -v wanted="$1" '
    BEGIN { n = split(wanted, list, /[ \n]+/); for (i = 1; i <= n; ++i) if (list[i] != "") want[list[i]] = 1 }
    $1 == "deb" || $1 == "deb-src" {
      address = $2; if ($2 ~ /^\[/) { i = 2; while ($i !~ /\]$/ && i < NF) ++i; address = $(i + 1) }
      sub("/+$", "", address)
      if (wanted == "" || address in want) { sub("^[ \t]*deb(-src)?", "deb-src"); print }
    }' "$2"
}
deb822() {
  grep -v '^#' "$2" | awk -v wanted="$1" '
    BEGIN { RS = ""; FS = "\n"; n = split(wanted, list, /[ \n]+/); for (i = 1; i <= n; ++i) if (list[i] != "") want[list[i]] = 1 }
    {
      text = ""; keep = (wanted == ""); disabled = 0; field = ""
      for (i = 1; i <= NF; ++i) {
        line = $i
        if (line !~ /^[ \t]/) { field = tolower(line); sub(":.*", "", field) }
        if (field == "types") { if (line !~ /^[ \t]/) text = text "Types: deb-src\n"; continue }
        if (field == "enabled" && tolower(line) ~ /(no|false|off|0)[ \t]*$/) disabled = 1
        if (field == "uris") {
          rest = line; if (line !~ /^[ \t]/) sub("^[^:]*:", "", rest)
          m = split(rest, word, /[ \t]+/)
          for (k = 1; k <= m; ++k) { address = word[k]; sub("/+$", "", address); if (address in want) keep = 1 }
        }
        text = text line "\n"
      }
      if (keep && !disabled) print text
    }'
}
collect() {
  : > "$work/parts/entries.list"; : > "$work/parts/entries.sources"
  eval "$(apt-config shell list Dir::Etc::sourcelist/f folder Dir::Etc::sourceparts/d)"
  for file in "$list" "$folder"/*.list; do
    if [ -f "$file" ]; then one_line "$1" "$file" >> "$work/parts/entries.list"; fi
  done
  for file in "$folder"/*.sources; do
    if [ -f "$file" ]; then { deb822 "$1" "$file"; echo; } >> "$work/parts/entries.sources"; fi
  done
  grep -q . "$work/parts/entries.list" "$work/parts/entries.sources"
}
collect "$wanted" || collect '' ||
  fail 'apt has no sources (sources.list and sources.list.d are empty); add the Debian archive to them'
[ -s "$work/parts/entries.list" ] || rm "$work/parts/entries.list"
grep -q . "$work/parts/entries.sources" || rm "$work/parts/entries.sources"

private() {
  user=''; [ "$(id -u)" != 0 ] || user='-o APT::Sandbox::User=root'
  # shellcheck disable=SC2086
  apt-get -q -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$work/parts" \
    -o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work/cache" -o Acquire::Retries=3 \
    -o Acquire::Languages=none -o APT::Update::Post-Invoke-Success::= $user "$@"
}

say "reading the lists of source packages (for openfoam $version)"
private update > "$work/update.log" 2>&1 || true  # a source that fails matters only if ours is in it
say 'downloading the source package (45 MB)'
if ! (cd "$work/download" && private source --download-only --tar-only "openfoam=$version") > "$work/source.log" 2>&1; then
  cat "$work/update.log" "$work/source.log" >&2
  fail "the source package openfoam $version could not be fetched; see the messages of apt above (no network, or a mirror without sources)"
fi

tarball=
for file in "$work"/download/openfoam_*.orig.tar.*; do
  case $file in *.asc) ;; *) [ ! -f "$file" ] || tarball=$file ;; esac
done
[ -n "$tarball" ] || fail 'apt reported success but left no orig tarball'

say 'unpacking the headers'
mkdir "$work/tree"
patterns=
for part in $parts; do patterns="$patterns */$part"; done
set -f  # the patterns are for tar
# shellcheck disable=SC2086
tar -xf "$tarball" -C "$work/tree" --strip-components=1 --no-same-owner --wildcards $patterns ||
  fail "$tarball cannot be unpacked (disk full?)"
set +f
[ -f "$work/tree/src/OpenFOAM/db/Time/Time.H" ] || fail 'the source package has another layout than expected: no src/OpenFOAM/db/Time/Time.H'
api=$(sed -n 's/^api=//p' "$work/tree/META-INFO/api-info")
case $version in
  "$api".*|*:"$api".*) ;;
  *) fail "the sources say api=$api, the installed package is version $version" ;;
esac

printf '%s\n' "$version" > "$work/tree/.hemoscale-headers"
chmod 755 "$work/tree"
rm -rf "$target"
mv "$work/tree" "$target" || fail "cannot write $target"
say "done: $target"
