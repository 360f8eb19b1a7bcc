# SPDX-License-Identifier: MIT
# coin.awk - draws the sprite sheet of the examples: a coin of 16 x 16 pixels that turns in 6 pictures, as PPM on magenta.
BEGIN {
    split("7 6 3 1 3 6", half, " ")
    print "P3\n96 16\n255"
    for (y = 0; y < 16; y++)
        for (cell = 1; cell <= 6; cell++)
            for (x = 0; x < 16; x++) {
                across = (x - 7.5) / (half[cell] + 0.5); down = (y - 7.5) / 7.5
                far = across * across + down * down
                if (far > 1)
                    print "255 0 255"
                else if (far > 0.66 || half[cell] < 2)
                    print "166 105 22"
                else if (x - 7.5 < -half[cell] * 0.2 && y < 6)
                    print "255 240 170"
                else
                    print "240 190 50"
            }
}
