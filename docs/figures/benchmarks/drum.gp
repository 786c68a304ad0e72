# Made by tests/bench/nine_codes.py; the published values are those of Dosta et al. 2024 (its docstring).
$data0 << END
0 15047
0.05 14970
0.1 14467
0.15 13925
0.2 13368
0.25 12880
0.3 12619
0.35 12753
0.4 13582
0.45 15374
0.5 18024
0.55 20968
0.6 23152
0.65 23318
0.7 22307
0.75 20727
0.8 18687
0.85 16463
0.9 14241
0.95 12057
1 10032
END
$data1 << END
0 3963
0.05 3734
0.1 3322
0.15 2914
0.2 2504
0.25 2100
0.3 1719
0.35 1367
0.4 1043
0.45 748
0.5 482
0.55 232
0.6 68
0.65 177
0.7 410
0.75 686
0.8 983
0.85 1264
0.9 1514
0.95 1745
1 1970
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
0.1 -0.0133333
0.2 -0.00666667
0.3 0.0166667
0.4 0.0666667
0.5 0.223333
0.6 0.293333
0.7 0.763333
0.8 0.946667
0.9 0.793333
1 0.443333
END
$data5 << END
0 0
0.1 0
0.2 0.05
0.3 0.0125
0.4 -0.0625
0.5 0.0625
0.6 0.175
0.7 -0.175
0.8 -0.2625
0.9 0.025
1 0.0625
END
do for [form in 'svg png'] {
if (form eq 'svg') { set terminal svg size 820,720 font 'DejaVu Sans,14' background 'white' } else { set terminal pngcairo size 1230,1080 font 'DejaVu Sans,18' }
set output 'drum.'.form
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
