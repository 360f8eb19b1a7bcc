#!/bin/sh
# SPDX-License-Identifier: MIT
# game_rates.sh [NAME...] - frames per second of the game while the recorded race is driven, blurred, on emulated machines: measures those
# named (pico gba pico2; none: nothing) into build/rates, then prints the table of README.md of all that have been measured. FROM: the
# frames of the race from which on some are counted.
#
# The Pico and the Game Boy Advance are seen from display to display. A Pico 2 is one of its cores, whose instructions count as cycles:
# the display of QEMU takes instructions of its own.
set -eu
out=build/rates
mkdir -p $out
MAKE=${MAKE:-make}
FROM=${FROM:-100 300 500 700 900 1100}

measure() {
    $MAKE --no-print-directory -s TARGET="$1" game-firmware >$out/"$1".log
    case $1 in
    pico) run='sh platform/pico/run.sh --exact 1 build/pico/breakout/game.elf drive pico-240' count=12 ;;
    gba) run='sh platform/gba/run.sh build/gba/game.elf drive gba' count=30 ;;
    pico2)
        $MAKE --no-print-directory -s TARGET=pico2 GAME_STEP=100 game-cost >$out/game-pico2
        return
        ;;
    esac
    for frame in $FROM; do
        $run "$frame" $count
    done >$out/"game-$1.new"
    mv $out/"game-$1.new" $out/"game-$1"
}

for name; do
    measure "$name"
done

# Mean of the whole: as many frames were counted at each place.
row='{ time += 1 / $5; n++; slowest = n == 1 || $5 < slowest ? $5 : slowest }
    END { printf "| %s | %s | %.1f | %.1f |\n", name, panel, n / time, slowest }'
echo '| | panel | frames per second, mean | slowest |'
echo '|---|---|---|---|'
[ ! -f $out/game-pico ] || awk -v name="Raspberry Pi Pico, both cores" -v panel=240x240 "$row" $out/game-pico
[ ! -f $out/game-pico2 ] || awk '/^mean/ { printf "| Raspberry Pi Pico 2, one core, at most | 240x240 | %.1f | %.1f |\n", 150e6 / $2, 150e6 / $4 }' $out/game-pico2
[ ! -f $out/game-gba ] || awk -v name="Game Boy Advance" -v panel=120x80 "$row" $out/game-gba
