# Shared by the scripts of this folder: where the project is, and what a machine with Debian 12 or 13 must have installed.
# shellcheck shell=bash
set -euo pipefail
umask 022  # what goes onto a robot is read there by others than its owner

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly project

# What each kind of build needs. The daemon's set is kept small on purpose: it is what a first run waits for.
readonly packages_gazed=(g++ cmake ninja-build libeigen3-dev liblcm-dev liblcm-bin libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libmsgpack-cxx-dev libjpeg-dev)
readonly packages_lab=(libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-calib3d-dev libopencv-video-dev libopencv-videoio-dev libopencv-highgui-dev libxcb1-dev libceres-dev libyaml-cpp-dev)
readonly packages_test=(libgtest-dev libgmock-dev libbenchmark-dev libopencv-features2d-dev gnuplot-nox iproute2)
readonly packages_java=(default-jdk-headless liblcm-java)
readonly packages_java_test=(junit4)
# lcm-spy's window and its charts; the headless JDK has neither.
readonly packages_spy=(default-jre libjchart2d-java)
# What gazed is tried with that is not C++ (toolchain/test's peers).
readonly packages_peers=("${packages_spy[@]}" xvfb python3 python3-venv)
# A browser, of those peers; Ubuntu's is no package but a snap, and the tests that need one are skipped there.
readonly packages_browser=(chromium chromium-driver)
# What a bundle is tried with: what the robots have, the shell and tools of V3.3 to V5 and the service manager of V6, and a network to hear it.
readonly packages_bundle=(busybox procps systemd iproute2)
# What toolchain/deploy is tried against.
readonly packages_deploy=(openssh-client openssh-server rsync iproute2 procps)
# What makes Debian packages: which packages a program's libraries are in, and a manual of what it says of itself.
readonly packages_package=(dpkg-dev file help2man)
# What makes the wheel of the Python module; the rest comes from PyPI.
readonly packages_wheel=(python3 python3-venv python3-dev)
# What reads the sources: .ci/run.
readonly packages_check=(clang-format git python3)
readonly packages_tidy=(clang-tidy-16)
# On the build machine for a robot: what generates and compiles, and the emulator for the tests.
readonly packages_cross=(cmake ninja-build liblcm-bin qemu-user python3)
# To run a robot's bundle on a whole emulated robot, and to watch it from outside.
readonly packages_robot=(qemu-system-x86 iproute2 kmod cpio liblcm-bin python3 python3-venv)
# To make a sysroot; newuidmap says whose the files are, in the user namespace of who is not root.
packages_sysroot_tools=(mmdebstrap debian-archive-keyring)
[ "$(id -u)" = 0 ] || packages_sysroot_tools+=(uidmap)
readonly packages_sysroot_tools
# In a robot's sysroot: gazed's libraries and those of the tests; base-files has the licences that Debian's copyrights refer to.
readonly packages_sysroot=(libc6-dev libstdc++-12-dev libeigen3-dev liblcm-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libmsgpack-cxx-dev
  libjpeg62-turbo-dev libopencv-core-dev libopencv-imgproc-dev libgtest-dev libgmock-dev base-files)

say() { printf '%s\n' "$*" >&2; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# need PACKAGE...: installs the Debian packages that are missing, and says which.
need() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if ! command -v apt-get >/dev/null; then
    say "These Debian packages are needed, and there is no apt-get to install them: ${missing[*]}"
    return 1
  fi
  say "Installing with apt: ${missing[*]}"
  local log
  log=$(mktemp)
  # Another installation may be under way, as on a machine that has just started: lists that cannot be fetched are no
  # fault if the old ones do, and dpkg's lock is waited for.
  if ! { as_root apt-get update || true; as_root env DEBIAN_FRONTEND=noninteractive \
           apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    say "apt could not install: ${missing[*]} (its whole output: $log)"
    return 1
  fi
  rm -f "$log"
}

# python_with PACKAGE...: makes build/python, a Python that has these PyPI packages, which live there and never in the system.
python_with() {
  local venv=$project/build/python package
  [ -x "$venv/bin/python" ] || python3 -m venv "$venv"
  for package in "$@"; do
    "$venv/bin/python" -c "import importlib.metadata as m; m.version('${package%%=*}')" 2>/dev/null && continue
    say "Installing with pip, into build/python: $package"
    "$venv/bin/pip" install --quiet --disable-pip-version-check "$package"
  done
}

# package_lists: fetches apt's lists where there are none, as on a fresh machine: it would know no package but those that are installed.
package_lists() {
  [ -z "$(find /var/lib/apt/lists -name '*_Packages*' -print -quit 2>/dev/null)" ] || return 0
  as_root apt-get update >/dev/null 2>&1 || true  # what is then needed and not found says so
}

# clang_version: of the instrumented builds' compiler: Debian 12's newest, or of what a later release has the first that works.
clang_version() {
  local version
  package_lists
  for version in 16 19 18 17; do
    if command -v "clang++-$version" >/dev/null || [ -n "$(apt-cache pkgnames "clang-$version" 2>/dev/null | head -n 1)" ]; then break; fi
  done
  echo "$version"
}

# packages_clang: that compiler, and what names the places in its reports.
packages_clang() {
  local version
  version=$(clang_version)
  echo "clang-$version" "libclang-rt-$version-dev" "llvm-$version"
}

# existing PACKAGE...: those of them that this machine's release has.
existing() {
  local package
  package_lists
  for package in "$@"; do apt-cache pkgnames "$package" 2>/dev/null | grep -x "$package" || true; done
}

# debian_mirror: where this machine has Debian from, or GAZED_DEBIAN_MIRROR. A mirror has all releases.
debian_mirror() {
  local mirror=${GAZED_DEBIAN_MIRROR:-}
  if [ -z "$mirror" ]; then
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' 'Component: main' | head -n 1)
  fi
  echo "${mirror:-http://deb.debian.org/debian}"  # another distribution's machine
}

# configure PRESET [cmake options]: makes build/PRESET, quietly unless it fails.
configure() {
  local output
  output=$(cd "$project" && cmake --preset "$@" 2>&1) || { printf '%s\n' "$output" >&2; return 1; }
}

# spy_jar: sets jar, the types and windows for lcm-spy, and builds it where its sources are newer.
spy_jar() {
  need "${packages_java[@]}"
  local build=$project/build/native output
  jar=$build/share/gazed_types.jar
  if [ -f "$jar" ] && [ -z "$(find "$project"/msgs/*.lcm "$project"/msgs/spy/*.java -newer "$jar" -print -quit)" ]; then return; fi
  need "${packages_gazed[@]}"
  if [ ! -f "$build/build.ninja" ]; then
    configure native -DBUILD_TESTING=OFF -DGAZED_LAB=OFF -DGAZED_JAVA=ON
  elif ! grep -q '^GAZED_JAVA:BOOL=ON$' "$build/CMakeCache.txt"; then
    cmake -DGAZED_JAVA=ON "$build" >/dev/null
  fi
  output=$(cmake --build "$build" --target gazed_types 2>&1) || { printf '%s\n' "$output" >&2; return 1; }
}

# debian_architecture_of PRESET: what Debian calls the robot's kind of program.
debian_architecture_of() {
  case $1 in
    nao-v4) echo i386 ;;
    nao-v6) echo amd64 ;;
    *) say "preset '$1' found; allowed: nao-v4, nao-v6"; return 2 ;;
  esac
}

# packages_of PRESET: the Debian packages to build all of a preset.
packages_of() {
  case $1 in
    native) echo "${packages_gazed[@]}" "${packages_lab[@]}" "${packages_test[@]}" "${packages_java[@]}" "${packages_java_test[@]}" ;;
    asan | debug) echo "${packages_gazed[@]}" "${packages_lab[@]}" "${packages_test[@]}" "$(packages_clang)" ;;
    # The sysroot's release has gcc 12, whose libstdc++ theirs must be.
    nao-v4) echo "${packages_cross[@]}" g++-12-i686-linux-gnu ;;
    nao-v6) echo "${packages_cross[@]}" g++-12 ;;
    *) say "preset '$1' found; allowed: native, debug, asan, nao-v4, nao-v6"; return 2 ;;
  esac
}

# What scripts of several steps do with them: none keeps the next from being tried, and the end lists them all.
#   attempt NAME COMMAND...    does it; start and finish: beside what comes between
#   summary                    what those that failed said last, and the list; its exit code is 1 when one failed
readonly failed_lines=100  # of a step that failed: a nested script's own summary fits
results=()
failures=()
passed=true  # the last that ended
running=

step_ended() {  # NAME SECONDS STATUS OUTPUT
  local outcome=passed
  passed=true
  if [ "$3" != 0 ]; then
    outcome=FAILED passed=false
    failures+=("== $1 failed; its last lines:"$'\n'"$(tail -n "$failed_lines" "$4")")
  fi
  results+=("$(printf '%-16s %s  %2d:%02d' "$1" $outcome $(($2 / 60)) $(($2 % 60)))")
}

attempt() {
  local name=$1 began=$SECONDS status output
  shift
  output=$(mktemp)
  set +e  # inside of a condition, bash would not end at a command that fails
  (set -e; "$@") 2>&1 | tee "$output" >&2
  status=${PIPESTATUS[0]}
  set -e
  step_ended "$name" $((SECONDS - began)) "$status" "$output"
  rm "$output"
}

start() {
  running=$(mktemp -d)
  (
    began=$SECONDS status=0
    "${@:2}" >"$running/output" 2>&1 || status=$?
    echo "$1|$((SECONDS - began))|$status" >"$running/end"
  ) &
  echo $! >"$running/pid"
}

# finish: waits for what was started, shows what it said, and puts it into the list.
finish() {
  [ -n "$running" ] || return 0
  local name seconds status
  wait "$(cat "$running/pid")"
  cat "$running/output" >&2
  IFS='|' read -r name seconds status <"$running/end"
  step_ended "$name" "$seconds" "$status" "$running/output"
  rm -r "$running"
  running=
}

summary() {
  local result code=0
  [ ${#failures[@]} = 0 ] || printf '%s\n' "${failures[@]}" >&2
  say "== took"
  for result in "${results[@]}"; do
    say "$result"
    [[ $result != *FAILED* ]] || code=1
  done
  return $code
}
