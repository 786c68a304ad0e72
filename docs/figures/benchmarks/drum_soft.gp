# Made by tests/bench/nine_codes.py; the published values are those of Dosta et al. 2024 (its docstring).
$data0 << END
0 15047
0.05 14994
0.1 14543
0.15 13994
0.2 13396
0.25 12801
0.3 12379
0.35 12298
0.4 12894
0.45 14538
0.5 17214
0.55 20266
0.6 22561
0.65 22634
0.7 21712
0.75 20177
0.8 18220
0.85 16038
0.9 13850
0.95 11784
1 9794
END
$data1 << END
0 3963
0.05 3768
0.1 3335
0.15 2920
0.2 2498
0.25 2094
0.3 1692
0.35 1342
0.4 1003
0.45 715
0.5 443
0.55 189
0.6 46
0.65 213
0.7 485
0.75 782
0.8 1108
0.85 1399
0.9 1672
0.95 1889
1 2091
END
$data2 << END
0.1 14471
0.2 13366
0.3 12609
0.4 13546
0.5 17904
0.6 22861
0.7 22117
0.8 18552
0.9 14112
1 9869
0.1 3319
0.2 2496
0.3 1716
0.4 1051
0.5 489
0.6 68
0.7 392
0.8 985
0.9 1548
1 2026
END
$data3 << END
0 15047
0.1 14471
0.2 13370
0.3 12614
0.4 13562
0.5 17957
0.6 23064
0.7 22078
0.8 18403
0.9 14003
1 9899
0 3963
0.1 3322
0.2 2500
0.3 1718
0.4 1048
0.5 477
0.6 54
0.7 424
0.8 1004
0.9 1512
1 1965
END
$data4 << END
0 0
0.1 0.24
0.2 0.0866667
0.3 -0.783333
0.4 -2.22667
0.5 -2.47667
0.6 -1.67667
0.7 -1.22
0.8 -0.61
0.9 -0.51
1 -0.35
END
$data5 << END
0 0
0.1 0.1625
0.2 -0.025
0.3 -0.325
0.4 -0.5625
0.5 -0.425
0.6 -0.1
0.7 0.7625
0.8 1.3
0.9 2
1 1.575
END
do for [form in 'svg png'] {
if (form eq 'svg') { set terminal svg size 820,720 font 'DejaVu Sans,14' background 'white' } else { set terminal pngcairo size 1230,1080 font 'DejaVu Sans,18' }
set output 'drum_soft.'.form
set grid
set key outside right top
set lmargin 11
set rmargin 24
set multiplot layout 2,1
set yrange [*:*]
set xlabel 'time, s'
set ylabel 'grains in the lower left quarter'
plot $data0 with lines lw 3 lc 1 title 'grainreel, M1', \
     $data1 with lines lw 3 lc 2 title 'grainreel, M2', \
     $data2 with points pt 6 ps 1.1 lc rgb 'black' title 'LIGGGHTS', \
     $data3 with points pt 2 ps 1.1 lc rgb 'black' title 'MUSEN'
set yrange [-6:6]
set xlabel 'time, s'
set ylabel 'off MUSEN, % of the grains'
plot [0:1] '+' using 1:(-5):(5) with filledcurves lc rgb '#dddddd' title 'allowed', \
     $data4 with lines lw 3 lc 1 title 'grainreel, M1', \
     $data5 with lines lw 3 lc 2 title 'grainreel, M2'
unset multiplot
}
