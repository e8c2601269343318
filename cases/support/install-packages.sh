#!/usr/bin/env bash
# install-packages.sh PURPOSE...   (purposes: build run test; see packages.txt)
# Installs the Debian packages that are missing. Works as root and with sudo; does nothing, and
# needs no rights, when all are present.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

wanted=()
for purpose in "$@"; do
  while IFS='|' read -r package need _; do
    case $package in '#'* | '') continue ;; esac
    [ "$(echo $need)" = "$purpose" ] && wanted+=("$(echo $package)")
  done <"$here/packages.txt"
done

missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "packages: all ${#wanted[@]} present"
  exit 0
fi
echo "packages: installing ${#missing[@]} of ${#wanted[@]}: ${missing[*]}"

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "error: the packages above are missing, and neither root rights nor sudo are at hand;" \
      "install them as root: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
