# What the tests in shell here have in common: how they fail, wait, and get a screen and a network of their own.
# shellcheck shell=bash

# fail WHAT...: ends the test; where it has a function `evidence`, with what that prints.
fail() {
  printf '%s: FAILED: %s\n' "${0##*/}" "$*" >&2
  if declare -F evidence >/dev/null; then evidence >&2; fi
  exit 1
}

# skip WHY...: what this machine lacks.
skip() {
  printf '%s: skipped: %s\n' "${0##*/}" "$*"
  exit 77
}

# until_true WHAT COMMAND...: waits for what must become true, for two minutes at most, or patience_s: the machine may be loaded. Where a test
# has a function `possible`, no longer than that says so.
until_true() {
  local what=$1 end=$((SECONDS + ${patience_s:-120}))
  shift
  until "$@"; do
    [ $SECONDS -lt $end ] || fail "does not come in ${patience_s:-120} s: $what"
    if declare -F possible >/dev/null && ! possible; then fail "cannot come any more: $what"; fi
    sleep 0.2
  done
}

# own_url [N]: LCM's, with a port of this process's own, so that tests do not hear each other.
own_url() { echo "udpm://239.255.76.67:$((20000 + ($$ * 3 + ${1:-0}) % 20000))?ttl=0"; }

# start_x: an X server without a screen, for this test alone; sets DISPLAY, and x_server to its pid. Its number is this process's own: servers that look
# for a free one by -displayfd take each other's socket away.
start_x() {
  local number=$((1000 + $$ % 50000))
  Xvfb ":$number" -noreset -screen 0 1400x1000x24 2>/dev/null &
  # shellcheck disable=SC2034  # for whoever ends it
  x_server=$!
  until_true "an X server" test -S "/tmp/.X11-unix/X$number"
  export DISPLAY=:$number
}
