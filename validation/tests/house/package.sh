#!/bin/sh
# The Debian package: made by cpack, with the libraries it needs as dependencies, and working from where it is unpacked.
#   package.sh BUILD WORK      exit code 77 without the tools that make one
set -eu
build=$1
work=$2
for tool in cpack dpkg-deb dpkg-shlibdeps file; do
  command -v $tool >/dev/null || {
    echo "SKIPPED: no $tool"
    exit 77
  }
done
rm -rf "$work" && mkdir -p "$work"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work" >"$work/log" 2>&1 || {
  cat "$work/log"
  exit 1
}
cd "$work"
dpkg-deb --field treejet_*.deb
dpkg-deb --field treejet_*.deb Depends | grep -q libhdf5 || {
  echo "FAILED: the package does not depend on HDF5"
  exit 1
}
dpkg-deb --extract treejet_*.deb root
dpkg-deb --contents treejet_*.deb | awk '{print $6}' >contents
for file in bin/treejet lib/ include/treejet/core/deck/deck.hpp share/man/man1/treejet.1 share/treejet/python/treejet/view.py; do
  grep -q "^./usr/$file" contents || {
    echo "FAILED: no $file in the package"
    exit 1
  }
done
! grep -vE '^./(usr/)?$|^./usr/(bin|lib|include|share)(/|$)' contents
root/usr/bin/treejet template >input.dat
root/usr/bin/treejet run input.dat --out run --quiet --set "final time 1.d-3"
[ -s run/statdat.dat ]
