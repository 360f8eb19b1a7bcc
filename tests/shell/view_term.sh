#!/bin/sh
# SPDX-License-Identifier: MIT
# view_term.sh - `smear view` in a terminal, through tmux: the picture is the frame, keys arrive, sizes
# down to one cell work, and the terminal is as it was before, whatever ended the program.
#
#     sh tests/shell/view_term.sh build/smear
. "$(dirname "$0")/view_lib.sh"
LC_ALL=C.UTF-8
export LC_ALL
tmux() { command tmux -S "$base/tmux" -u -f /dev/null "$@"; }
trap 'tmux kill-server 2>/dev/null; rm -rf "$base"' EXIT
cd "$base" || exit 1

# A shell in a terminal of 80x24; whatever ran in it has to leave its prompt usable.
tmux new-session -d -x 80 -y 24 -s t "env PS1='ready ' LC_ALL=C.UTF-8 COLORTERM=truecolor sh" || exit 1
say() { tmux send-keys -t t "$@"; }
seen() { tmux capture-pane -p -t t; }
sees() { seen | grep -e "$1"; }
sees_not() { ! sees "$1"; }
is_full() { [ "$(seen | grep -c '▀')" -ge "${1:-20}" ]; }
start() { # OPTIONS...: in the terminal, until a picture is there
    tmux clear-history -t t
    say "clear; '$smear' view --out term $*; echo status \$?" Enter
    wait_for 30 is_full
}
ended() { wait_for 20 sees "^status $1" ; }
process() { pgrep -P "$(tmux display-message -p -t t '#{pane_pid}')"; }

# The terminal's settings are those of the beginning, the cursor is on, there are no colours.
wait_for 10 sees '^ready' || exit 1
tty=$(tmux display-message -p -t t '#{pane_tty}')
settings=$(stty -g <"$tty") || exit 1
restored() {
    say "clear" Enter
    wait_for 10 sees '^ready *$' || return 1
    equals "$(stty -g <"$tty")" "$settings" || return 1
    equals "$(tmux display-message -p -t t '#{cursor_flag}')" 1 &&
        equals "$(tmux display-message -p -t t '#{alternate_on}')" 0 &&
        equals "$(tmux display-message -p -t t '#{mouse_any_flag}')" 0 || return 1
    say "echo typ''ed" Enter
    # behind a prompt where the keys came while `clear` ran
    wait_for 30 sees 'typed' && [ -z "$(tmux capture-pane -p -e -t t | tr -cd '\033')" ]
}

# ------------------------------------------------------------------ the picture

# The colours of the cells, two pixels each, as a PPM.
rebuild() { # COLUMNS ROWS
    tmux capture-pane -p -e -N -t t | awk -v columns="$1" -v rows="$2" '
        function set(parameters, p, n, i) {
            n = split(parameters, p, ";")
            for (i = 1; i <= n; i++) {
                if (p[i] == 38 && p[i + 1] == 2) { f = p[i + 2] " " p[i + 3] " " p[i + 4]; i += 4 }
                else if (p[i] == 48 && p[i + 1] == 2) { b = p[i + 2] " " p[i + 3] " " p[i + 4]; i += 4 }
                else if (p[i] == 0) { f = "255 255 255"; b = "0 0 0" }
            }
        }
        BEGIN { print "P3"; print columns, rows * 2; print 255 }
        NR <= rows {
            upper = lower = ""; rest = $0; count = 0
            while (rest != "") {
                if (substr(rest, 1, 2) == "\033[") {
                    end = index(rest, "m")
                    set(substr(rest, 3, end - 3))
                    rest = substr(rest, end + 1)
                } else if (substr(rest, 1, length("▀")) == "▀") {
                    upper = upper f "\n"; lower = lower b "\n"; count++
                    rest = substr(rest, length("▀") + 1)
                } else {
                    upper = upper b "\n"; lower = lower b "\n"; count++
                    rest = substr(rest, 2)
                }
            }
            printf "%s%s", upper, lower
        }' >"$base/seen.ppm"
}

# the frame fills 80x48 pixels exactly, so nothing is enlarged or shrunk
shows_frame() {
    start $race --size 80x48 --paused || return 1
    wait_for 10 sees_not 'controls' || return 1
    sleep 0.3
    rebuild 80 24
    "$smear" render $race --size 80x48 --frames 0-0 -o want.png &&
        "$smear" compare want.png seen.ppm >"$base/compare" && has "$base/compare" 'rmse=0.000000$' ||
        { cat "$base/compare"; return 1; }
}
claim "the picture is the frame, pixel by pixel" shows_frame

next_frame() { # only the cells that changed were written; the whole is right
    say .
    say .
    say .
    sleep 1
    rebuild 80 24
    "$smear" render $race --size 80x48 --frames 3-3 -o want.png &&
        "$smear" compare want.png seen.ppm >"$base/compare" && has "$base/compare" 'rmse=0.000000$' ||
        { cat "$base/compare"; return 1; }
}
claim "and so it is three frames later" next_frame

claim "? lists the controls" eval 'say "?" && wait_for 10 sees "split screen"'
claim "escape closes the list" eval 'say Escape && wait_for 10 sees_not "split screen"'
claim "o shows figures" eval 'say o && wait_for 10 sees "crc32"'
claim "arrow keys turn the camera" eval 'say o && say Right && sleep 1 && rebuild 80 24 &&
    "$smear" compare want.png seen.ppm >compare && ! grep -q "rmse=0.000000$" compare'
claim "q ends it" eval 'say q && ended 0'
claim "the terminal is as before after q" restored

palette() {
    start $race --size 80x48 --paused --colors 256 || return 1
    tmux capture-pane -p -e -t t >cells
    grep -q '48;5;' cells && ! grep -q '48;2;' cells || { head -c 300 cells; return 1; }
    say q
    ended 0
}
claim "256 colours" palette

no_utf8() {
    say "clear; LC_ALL=C '$smear' view --out term $race --paused; echo status \$?" Enter
    wait_for 20 sees 'lists the controls' || return 1
    tmux capture-pane -p -t t | grep -q '▀' && { echo "half blocks"; return 1; }
    tmux capture-pane -p -e -t t | grep -q '48;2;' || return 1
    say q
    ended 0
}
claim "without half blocks" no_utf8

# ------------------------------------------------------------------ ends

claim "runs" start
claim "Ctrl-C ends it" eval 'say C-c && ended 0'
claim "the terminal is as before after Ctrl-C" restored
for signal in TERM INT HUP QUIT; do
    claim "runs again" start
    claim "SIG$signal ends it" eval "kill -$signal \$(process) && ended 0"
    claim "the terminal is as before after SIG$signal" restored
done
for signal in SEGV ABRT; do
    claim "runs again" start
    claim "SIG$signal ends it" eval "kill -$signal \$(process) && ended 1[0-9][0-9]"
    claim "the terminal is as before after SIG$signal" restored
done
suspends() {
    start || return 1
    say C-z
    wait_for 10 sees 'Stopped' || return 1
    restored || return 1
    say fg Enter
    wait_for 20 is_full || return 1
    say q
    wait_for 20 sees_not '▀'
}
claim "Ctrl-Z gives the terminal back, fg goes on" suspends
claim "the terminal is as before after fg" restored

# ------------------------------------------------------------------ sizes

resizes() {
    start || return 1
    for size in '1 1' '2 1' '1 9' '200 60' '3 50' '80 24'; do
        tmux resize-window -t t -x "${size% *}" -y "${size#* }" || return 1
        sleep 0.4
        [ -n "$(process)" ] || { echo "gone at $size"; return 1; }
    done
    wait_for 20 is_full 24 || return 1
    say q
    ended 0
}
claim "any size, down to one cell, and back" resizes
claim "the terminal is as before after that" restored

# ------------------------------------------------------------------ the terminal goes

vanishes() {
    start || return 1
    number=$(process)
    tmux kill-server
    wait_for 20 eval '! kill -0 "$number" 2>/dev/null'
}
claim "ends when the terminal goes" vanishes

finish
